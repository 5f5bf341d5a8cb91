# Optional and required parts. A part gives its module include paths and a definition; the library links it, and the installed package
# asks for the pkg-config modules of PIA_PART_MODULES when it is static.

find_package(PkgConfig REQUIRED)
set(PIA_PART_LIBRARIES "")
set(PIA_PART_MODULES "")

pkg_check_modules(JANSSON REQUIRED IMPORTED_TARGET jansson)
pkg_check_modules(ZLIB REQUIRED IMPORTED_TARGET zlib)
list(APPEND PIA_PART_LIBRARIES PkgConfig::JANSSON PkgConfig::ZLIB)
list(APPEND PIA_PART_MODULES jansson zlib)

# pia_part(NAME pkg-config-module): sets PIA_HAVE_NAME and the imported target PkgConfig::NAME as PIA_WITH_NAME asks.
macro(pia_part name)
  set(PIA_HAVE_${name} OFF)
  if(NOT PIA_WITH_${name} STREQUAL "OFF")
    pkg_check_modules(${name} IMPORTED_TARGET ${ARGN})
    if(${name}_FOUND)
      set(PIA_HAVE_${name} ON)
      list(APPEND PIA_PART_LIBRARIES PkgConfig::${name})
      list(APPEND PIA_PART_MODULES ${ARGN})
    elseif(PIA_WITH_${name} STREQUAL "ON")
      message(FATAL_ERROR "PIA_WITH_${name}=ON, but ${ARGN} was not found")
    endif()
  endif()
endmacro()

pia_part(CAIRO cairo)

# CHOLMOD has no pkg-config module: a header and a library. PIA_PART_PLAIN are the libraries that pia.pc names by themselves.
set(PIA_PART_PLAIN "")
set(PIA_HAVE_CHOLMOD OFF)
if(NOT PIA_WITH_CHOLMOD STREQUAL "OFF")
  find_path(CHOLMOD_INCLUDE suitesparse/cholmod.h)
  find_library(CHOLMOD_LIBRARY cholmod)
  if(CHOLMOD_INCLUDE AND CHOLMOD_LIBRARY)
    set(PIA_HAVE_CHOLMOD ON)
    add_library(PkgConfig::CHOLMOD INTERFACE IMPORTED)
    target_include_directories(PkgConfig::CHOLMOD INTERFACE ${CHOLMOD_INCLUDE})
    list(APPEND PIA_PART_LIBRARIES cholmod)
    list(APPEND PIA_PART_PLAIN -lcholmod)
  elseif(PIA_WITH_CHOLMOD STREQUAL "ON")
    message(FATAL_ERROR "PIA_WITH_CHOLMOD=ON, but suitesparse/cholmod.h and libcholmod were not found")
  endif()
endif()

# OpenCASCADE is used by the plug-in and by tests only, never by the library.
set(PIA_HAVE_OCCT OFF)
if(NOT PIA_WITH_OCCT STREQUAL "OFF")
  include(CheckLanguage)
  check_language(CXX)
  find_path(PIA_OCCT_INCLUDE STEPControl_Reader.hxx PATH_SUFFIXES opencascade)
  if(PIA_OCCT_INCLUDE AND CMAKE_CXX_COMPILER)
    set(PIA_HAVE_OCCT ON)
    enable_language(CXX)
  elseif(PIA_WITH_OCCT STREQUAL "ON")
    message(FATAL_ERROR "PIA_WITH_OCCT=ON, but STEPControl_Reader.hxx (libocct-data-exchange-dev) or a C++ compiler was not found")
  endif()
endif()
