# Tells host/run/build_info.cpp version, git revision and flags; it is rebuilt when they change.
find_package(Git QUIET)
set(HOPSCOTCH_REVISION "unknown")
if(GIT_FOUND)
    execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty --abbrev=12
        WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} OUTPUT_VARIABLE HOPSCOTCH_REVISION
        OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    # configure again when the checked-out commit changes
    if(EXISTS ${CMAKE_SOURCE_DIR}/.git/HEAD)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/.git/HEAD)
    endif()
    if(EXISTS ${CMAKE_SOURCE_DIR}/.git/logs/HEAD)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/.git/logs/HEAD)
    endif()
endif()
string(JOIN " " HOPSCOTCH_FLAGS_TEXT ${CMAKE_BUILD_TYPE} ${CMAKE_CXX_FLAGS_RELEASE}
    -march=x86-64-v3 -ffp-contract=off kernels: ${HOPSCOTCH_FLAGS_avx512})
set_source_files_properties(host/run/build_info.cpp PROPERTIES COMPILE_DEFINITIONS
    "HOPSCOTCH_VERSION=\"${PROJECT_VERSION}\";HOPSCOTCH_REVISION=\"${HOPSCOTCH_REVISION}\";HOPSCOTCH_FLAGS=\"${HOPSCOTCH_FLAGS_TEXT}\"")
