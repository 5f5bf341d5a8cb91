# The installed package: library, header, executable, find_package(pia), pkg-config, man pages, completion. Everything in it is found
# relative to itself, so that an installed tree may be moved.

include(CMakePackageConfigHelpers)

function(pia_install_library)
  set(config ${CMAKE_INSTALL_LIBDIR}/cmake/pia)
  install(TARGETS pia EXPORT pia ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/pia DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT pia NAMESPACE pia:: FILE piaTargets.cmake DESTINATION ${config})
  configure_package_config_file(cmake/piaConfig.cmake.in piaConfig.cmake INSTALL_DESTINATION ${config})
  write_basic_package_version_file(piaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/piaConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/piaConfigVersion.cmake DESTINATION ${config})

  list(JOIN PIA_PART_MODULES " " requires)
  list(JOIN PIA_PART_PLAIN " " plain)
  file(RELATIVE_PATH up /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
  configure_file(cmake/pia.pc.in pia.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/pia.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

# A man page is docs/man/NAME.SECTION.scd; it is made where scdoc is found.
function(pia_install_manuals)
  file(GLOB sources CONFIGURE_DEPENDS docs/man/*.scd)
  find_program(SCDOC scdoc)
  if(NOT sources OR NOT SCDOC)
    return()
  endif()
  foreach(source ${sources})
    get_filename_component(page ${source} NAME_WLE)
    get_filename_component(section ${page} LAST_EXT)
    string(SUBSTRING ${section} 1 -1 section)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/man/${page})
    add_custom_command(OUTPUT ${output} DEPENDS ${source} VERBATIM
      COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/man
      COMMAND sh -c "exec \"$0\" <\"$1\" >\"$2\"" ${SCDOC} ${source} ${output})
    list(APPEND pages ${output})
    install(FILES ${output} DESTINATION ${CMAKE_INSTALL_MANDIR}/man${section})
  endforeach()
  add_custom_target(manuals ALL DEPENDS ${pages})
endfunction()

function(pia_install_command)
  if(NOT TARGET pia_cli)
    return()
  endif()
  file(RELATIVE_PATH up /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
  set_target_properties(pia_cli PROPERTIES INSTALL_RPATH "$ORIGIN/${up}")
  install(TARGETS pia_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  if(EXISTS ${PROJECT_SOURCE_DIR}/cli/pia.bash)
    install(FILES cli/pia.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME pia)
  endif()
endfunction()

pia_install_library()
pia_install_command()
pia_install_manuals()
