# Modules are object libraries whose include path lists exactly what they may include, so the compiler enforces the layering.

find_package(Threads REQUIRED)

add_library(pia_flags INTERFACE)
target_compile_features(pia_flags INTERFACE c_std_17)
# -ffp-contract=off: a result must not depend on which compiler saw a multiplication beside an addition.
target_compile_options(pia_flags INTERFACE -ffp-contract=off -fno-math-errno -Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes
  -Wmissing-prototypes -Wno-psabi -Wvla -Wundef -Wwrite-strings -Wcast-qual $<$<C_COMPILER_ID:GNU>:-Wno-format-truncation> $<$<BOOL:${PIA_WERROR}>:-Werror>)
target_compile_definitions(pia_flags INTERFACE _GNU_SOURCE PIA_VERSION="${PROJECT_VERSION}")

set(PIA_OBJECTS "" CACHE INTERNAL "")
set(PIA_SOURCE ${CMAKE_CURRENT_SOURCE_DIR}/src)

# pia_module(folder [folders it may include]...)
function(pia_module folder)
  file(GLOB sources CONFIGURE_DEPENDS ${PIA_SOURCE}/${folder}/*.c)
  if(NOT sources)
    return()
  endif()
  string(REPLACE "/" "_" name pia_${folder})
  add_library(${name} OBJECT ${sources})
  target_link_libraries(${name} PRIVATE pia_flags)
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON C_VISIBILITY_PRESET hidden)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/include ${PIA_SOURCE}/${folder})
  foreach(other ${ARGN})
    target_include_directories(${name} PRIVATE ${PIA_SOURCE}/${other})
  endforeach()
  set(PIA_OBJECTS ${PIA_OBJECTS} ${name} CACHE INTERNAL "")
endfunction()

# pia_part_file(module stem PART): of the files stem_<part>.c and stem_none.c the module keeps the one this build can have.
function(pia_part_file module stem part)
  string(TOLOWER ${part} file)
  set(left_out ${file})
  if(PIA_HAVE_${part})
    set(left_out none)
    target_link_libraries(pia_${module} PRIVATE PkgConfig::${part})
  endif()
  set_source_files_properties(${PIA_SOURCE}/${module}/${stem}_${left_out}.c PROPERTIES HEADER_FILE_ONLY ON)
endfunction()

# pia_embed(module file MACRO embedded): the source file takes in another one of its folder, whose path it knows as MACRO.
function(pia_embed module file macro embedded)
  set_property(SOURCE ${PIA_SOURCE}/${module}/${file} APPEND PROPERTY OBJECT_DEPENDS ${PIA_SOURCE}/${module}/${embedded})
  set_property(SOURCE ${PIA_SOURCE}/${module}/${file} APPEND PROPERTY COMPILE_DEFINITIONS ${macro}="${PIA_SOURCE}/${module}/${embedded}")
endfunction()

# pia_registry(module/function type pattern...): every file that matches exports one record named pia_<file name>, and
# `const type *function(pia_index)` lists them in the order of the patterns, by name within a pattern.
function(pia_registry target type)
  get_filename_component(module ${target} DIRECTORY)
  get_filename_component(function ${target} NAME)
  if(NOT TARGET pia_${module})
    return()
  endif()
  set(declarations "")
  set(entries "")
  foreach(pattern ${ARGN})
    file(GLOB files CONFIGURE_DEPENDS ${PIA_SOURCE}/${pattern})
    list(SORT files)
    foreach(file ${files})
      get_filename_component(symbol ${file} NAME_WE)
      string(APPEND declarations "extern const ${type} pia_${symbol};\n")
      string(APPEND entries "    &pia_${symbol},\n")
    endforeach()
  endforeach()
  set(output ${CMAKE_CURRENT_BINARY_DIR}/registry/${function}.c)
  file(CONFIGURE OUTPUT ${output} CONTENT
"#include \"${module}.h\"

${declarations}
const ${type} *${function}(pia_index index)
{
    static const ${type} *const entry[] = {
${entries}    NULL};
    return index >= 0 && index < (pia_index)(sizeof entry / sizeof *entry) ? entry[index] : NULL;
}
" @ONLY)
  target_sources(pia_${module} PRIVATE ${output})
endfunction()

# The library from all modules, and its installed package.
function(pia_library)
  set(objects "")
  foreach(name ${PIA_OBJECTS})
    list(APPEND objects $<TARGET_OBJECTS:${name}>)
  endforeach()
  add_library(pia ${objects})
  add_library(pia::pia ALIAS pia)
  target_include_directories(pia PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(pia PRIVATE m Threads::Threads ${PIA_PART_LIBRARIES})
  set_target_properties(pia PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR} LINKER_LANGUAGE C)
endfunction()
