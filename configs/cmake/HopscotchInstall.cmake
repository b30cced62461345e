# `cmake --install`: library, headers, CMake package and the program.
include(CMakePackageConfigHelpers)
set_target_properties(hopscotch_kernels PROPERTIES EXPORT_NAME kernels)
set_target_properties(hopscotch_host PROPERTIES EXPORT_NAME hopscotch)
set_target_properties(hopscotch_analysis PROPERTIES EXPORT_NAME analysis)
set_target_properties(hopscotch_flags PROPERTIES EXPORT_NAME flags)
install(TARGETS hopscotch_kernels hopscotch_host hopscotch_analysis hopscotch_flags
    EXPORT hopscotch_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS hopscotch_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY kernels host analysis
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hopscotch FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY analysis/python/hopscotch DESTINATION ${CMAKE_INSTALL_DATADIR}/hopscotch/python
    FILES_MATCHING PATTERN "*.py")
set(HOPSCOTCH_PACKAGE ${CMAKE_INSTALL_LIBDIR}/cmake/hopscotch)
install(DIRECTORY kernels/ensemble/units DESTINATION ${HOPSCOTCH_PACKAGE})
install(FILES configs/cmake/HopscotchModels.cmake configs/cmake/HopscotchTargets.cmake configs/cmake/HopscotchCuda.cmake
    configs/cmake/HopscotchCudaChoice.cmake
    DESTINATION ${HOPSCOTCH_PACKAGE})
install(EXPORT hopscotch_targets NAMESPACE hopscotch:: DESTINATION ${HOPSCOTCH_PACKAGE})
configure_package_config_file(configs/cmake/hopscotch-config.cmake.in
    ${CMAKE_BINARY_DIR}/hopscotch-config.cmake INSTALL_DESTINATION ${HOPSCOTCH_PACKAGE})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/hopscotch-config-version.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/hopscotch-config.cmake
    ${CMAKE_BINARY_DIR}/hopscotch-config-version.cmake DESTINATION ${HOPSCOTCH_PACKAGE})

# `cmake --install BUILD --component portable --prefix DIR`: one folder that runs on other machines of this
# architecture with a C library at least as new: the program, the libraries it needs beside it, scenes
# and the Python loader. CUDA's runtime is linked statically, so that a GPU needs the driver and no more.
# The program's RPATH (not RUNPATH) is $ORIGIN, because the libraries look for theirs by it too.
set_target_properties(hopscotch_program PROPERTIES INSTALL_RPATH "$ORIGIN")
target_link_options(hopscotch_program PRIVATE -Wl,--disable-new-dtags)
install(TARGETS hopscotch_program RUNTIME DESTINATION . COMPONENT portable EXCLUDE_FROM_ALL)
install(CODE [[
    file(GET_RUNTIME_DEPENDENCIES EXECUTABLES "${CMAKE_INSTALL_PREFIX}/hopscotch"
        RESOLVED_DEPENDENCIES_VAR libraries UNRESOLVED_DEPENDENCIES_VAR missing
        PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|rt|pthread|resolv|util)\\.so" "^libcuda\\.so")
    if(missing)
        message(FATAL_ERROR "portable: ${missing} (not found on this machine)")
    endif()
    file(INSTALL DESTINATION "${CMAKE_INSTALL_PREFIX}" TYPE SHARED_LIBRARY FOLLOW_SYMLINK_CHAIN
        FILES ${libraries})
    file(GLOB libraries "${CMAKE_INSTALL_PREFIX}/*.so*")
    foreach(library ${libraries})  # a library with a RUNPATH does not look beside the program
        unset(paths)
        file(READ_ELF ${library} RUNPATH paths)
        if(paths AND NOT IS_SYMLINK ${library})
            file(RPATH_SET FILE ${library} NEW_RPATH "$ORIGIN")
        endif()
    endforeach()]]
    COMPONENT portable EXCLUDE_FROM_ALL)
install(DIRECTORY configs/scenes DESTINATION . COMPONENT portable EXCLUDE_FROM_ALL)
install(DIRECTORY analysis/python/hopscotch DESTINATION python COMPONENT portable EXCLUDE_FROM_ALL
    FILES_MATCHING PATTERN "*.py")
install(FILES LICENSE DESTINATION . COMPONENT portable EXCLUDE_FROM_ALL)
