# Turns model headers into instantiation units: for a header NAME.hpp, which defines the model
# `hopscotch::NAME`, one object per target, one for the other arithmetics, one entry; and a registry of
# all entries. Where CUDA is in use, also the kernels for GPUs. Installed with the package, so that a user's own model is built the same way.
get_filename_component(HOPSCOTCH_UNITS ${CMAKE_CURRENT_LIST_DIR}/../../kernels/ensemble/units ABSOLUTE)
if(NOT EXISTS ${HOPSCOTCH_UNITS})
    set(HOPSCOTCH_UNITS ${CMAKE_CURRENT_LIST_DIR}/units)
endif()

function(hopscotch_add_models library)
    set(entries "")
    set(declarations "")
    set(names "")
    foreach(header ${ARGN})
        get_filename_component(model ${header} NAME_WE)
        list(APPEND names ${model})
        set(folder ${CMAKE_CURRENT_BINARY_DIR}/units/${model})
        get_filename_component(model_header ${header} ABSOLUTE)
        # the project's own headers by their include path: units are then the same text in every checkout
        string(REPLACE "${PROJECT_SOURCE_DIR}/kernels/" "kernels/" model_header ${model_header})
        foreach(target ${HOPSCOTCH_TARGETS})
            set(unit ${folder}/${target}.cpp)
            set(tangent_unit ${folder}/${target}_tangent.cpp)
            configure_file(${HOPSCOTCH_UNITS}/kernels.cpp.in ${unit} @ONLY)
            configure_file(${HOPSCOTCH_UNITS}/tangent.cpp.in ${tangent_unit} @ONLY)
            target_sources(${library} PRIVATE ${unit} ${tangent_unit})
            set(options "${HOPSCOTCH_FLAGS_${target}};-fno-sanitize=all;-Wno-uninitialized")
            set_source_files_properties(${unit} PROPERTIES COMPILE_OPTIONS "${options}")
            # -O3 makes the tangent ensembles no faster
            set_source_files_properties(${tangent_unit} PROPERTIES COMPILE_OPTIONS "${options};-O2")
            set_source_files_properties(${unit} ${tangent_unit} PROPERTIES COMPILE_DEFINITIONS
                    "HOPSCOTCH_TARGET=${target};HOPSCOTCH_REGISTERS=${HOPSCOTCH_REGISTERS_${target}}")
        endforeach()
        hopscotch_add_gpu_units(${library} ${model} ${model_header} ${folder})
        foreach(unit entry orbits)
            configure_file(${HOPSCOTCH_UNITS}/${unit}.cpp.in ${folder}/${unit}.cpp @ONLY)
            target_sources(${library} PRIVATE ${folder}/${unit}.cpp)
        endforeach()
        set_source_files_properties(${folder}/orbits.cpp PROPERTIES COMPILE_OPTIONS "-O1")
    endforeach()
    # a program with models of its own lists the library's too; its registry then replaces the library's
    set(HOPSCOTCH_MODEL_NAMES ${names} PARENT_SCOPE)
    list(APPEND names ${HOPSCOTCH_BUILTIN_MODELS})
    list(SORT names)
    foreach(model ${names})
        string(APPEND declarations "extern const model_entry ${model}_entry;\n")
        string(APPEND entries "    &${model}_entry,\n")
    endforeach()
    configure_file(${HOPSCOTCH_UNITS}/registry.cpp.in
        ${CMAKE_CURRENT_BINARY_DIR}/units/registry.cpp @ONLY)
    target_sources(${library} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/units/registry.cpp)
endfunction()

# A model's kernels for GPUs; the entry unit is told through these two variables.
function(hopscotch_add_gpu_units library model model_header folder)
    set(gpu_declarations "")
    set(gpu_tables "")
    foreach(kind kernels tangents)
        if(NOT HOPSCOTCH_HAS_CUDA)
            break()
        endif()
        set(unit ${folder}/cuda_${kind}.cu)
        configure_file(${HOPSCOTCH_UNITS}/cuda_${kind}.cu.in ${unit} @ONLY)
        target_sources(${library} PRIVATE ${unit})
        set_source_files_properties(${unit} PROPERTIES COMPILE_DEFINITIONS HOPSCOTCH_TARGET=cuda
            COMPILE_OPTIONS "${HOPSCOTCH_CUDA_FLAGS}")
        string(APPEND gpu_declarations "extern const ensemble_function* const ${model}_cuda_${kind};\n")
        string(APPEND gpu_tables
            "    entry.${kind}[static_cast<int>(backend::cuda)] = &${model}_cuda_${kind};\n")
    endforeach()
    set(gpu_declarations "${gpu_declarations}" PARENT_SCOPE)
    set(gpu_tables "${gpu_tables}" PARENT_SCOPE)
endfunction()

# A program with every command of Hopscotch that knows the models in the headers given as well as the
# built-in ones.
function(hopscotch_add_program name)
    file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${name}_main.cpp
        "// Generated: Hopscotch's commands with more models.\n#include \"host/cli/commands.hpp\"\n\nint main(int argc, char** argv) { return hopscotch::run_program(argc, argv); }\n")
    add_executable(${name} ${CMAKE_CURRENT_BINARY_DIR}/${name}_main.cpp)
    set_target_properties(${name} PROPERTIES CXX_STANDARD 20)
    target_link_libraries(${name} PRIVATE hopscotch::hopscotch)
    hopscotch_add_models(${name} ${ARGN})
endfunction()
