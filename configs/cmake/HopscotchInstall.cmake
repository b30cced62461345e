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
install(FILES configs/cmake/HopscotchModels.cmake configs/cmake/HopscotchTargets.cmake
    DESTINATION ${HOPSCOTCH_PACKAGE})
install(EXPORT hopscotch_targets NAMESPACE hopscotch:: DESTINATION ${HOPSCOTCH_PACKAGE})
configure_package_config_file(configs/cmake/hopscotch-config.cmake.in
    ${CMAKE_BINARY_DIR}/hopscotch-config.cmake INSTALL_DESTINATION ${HOPSCOTCH_PACKAGE})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/hopscotch-config-version.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/hopscotch-config.cmake
    ${CMAKE_BINARY_DIR}/hopscotch-config-version.cmake DESTINATION ${HOPSCOTCH_PACKAGE})
