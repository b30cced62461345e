# Decides whether kernels are compiled for GPUs: HOPSCOTCH_HAS_CUDA. AUTO asks for nvcc and for a driver,
# so that a build on a machine without a GPU is not slowed down by nvcc; ON (preset `cuda`) asks for nvcc
# alone. Installed with the package: a user's own models are built for GPUs as the library's are.
find_program(HOPSCOTCH_NVCC nvcc HINTS ENV CUDA_PATH ENV CUDA_HOME PATHS /usr/local/cuda/bin)
find_library(HOPSCOTCH_CUDA_DRIVER NAMES cuda libcuda.so.1 NO_CMAKE_FIND_ROOT_PATH)

include(${CMAKE_CURRENT_LIST_DIR}/HopscotchCudaChoice.cmake)
set(driver "${HOPSCOTCH_CUDA_DRIVER}")
if(NOT driver AND EXISTS /dev/nvidiactl)
    set(driver /dev/nvidiactl)
endif()
hopscotch_choose_cuda(HOPSCOTCH_HAS_CUDA "${HOPSCOTCH_WITH_CUDA}" "${HOPSCOTCH_NVCC}" "${driver}")

# Bit identity: no contraction; fma is written where it is meant. HOPSCOTCH_CUDA_FAST gives it up.
set(HOPSCOTCH_CUDA_FLAGS --expt-relaxed-constexpr -prec-div=true -prec-sqrt=true -diag-suppress=1675)
if(HOPSCOTCH_CUDA_FAST)
    list(APPEND HOPSCOTCH_CUDA_FLAGS -fmad=true)
else()
    list(APPEND HOPSCOTCH_CUDA_FLAGS -fmad=false)
endif()

if(HOPSCOTCH_HAS_CUDA)
    set(CMAKE_CUDA_COMPILER ${HOPSCOTCH_NVCC})
    set(CMAKE_CUDA_HOST_COMPILER ${CMAKE_CXX_COMPILER})
    if(NOT DEFINED CMAKE_CUDA_ARCHITECTURES)
        set(CMAKE_CUDA_ARCHITECTURES 80-real 90)  # and PTX, from which the driver compiles for later ones
    endif()
    enable_language(CUDA)
    if(CMAKE_CUDA_COMPILER_VERSION VERSION_LESS 12)
        message(FATAL_ERROR "nvcc ${CMAKE_CUDA_COMPILER_VERSION} (C++20 needs 12); HOPSCOTCH_WITH_CUDA=OFF?")
    endif()
    if(NOT CMAKE_CUDA20_STANDARD_COMPILE_OPTION)  # CMake 3.25.1 does not know it yet
        set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION -std=c++20)
        set(CMAKE_CUDA20_EXTENSION_COMPILE_OPTION -std=c++20)
        list(APPEND CMAKE_CUDA_COMPILE_FEATURES cuda_std_20)
    endif()
    set(CMAKE_CUDA_STANDARD 20)
    set(CMAKE_CUDA_STANDARD_REQUIRED ON)
    find_package(CUDAToolkit REQUIRED)
endif()

# The runtime's part of the host library.
function(hopscotch_add_cuda target)
    if(HOPSCOTCH_HAS_CUDA)
        target_sources(${target} PRIVATE host/device/cuda_runtime.cu host/device/devices.cu)
        # the oldest architecture, to which the runtime's part compares what it finds
        string(REGEX MATCHALL "[0-9]+" architectures "${CMAKE_CUDA_ARCHITECTURES}")
        list(SORT architectures COMPARE NATURAL)
        list(APPEND architectures 0)  # `native`, say: any
        list(GET architectures 0 oldest)
        set_source_files_properties(host/device/cuda_runtime.cu PROPERTIES
            COMPILE_DEFINITIONS HOPSCOTCH_LEAST_CAPABILITY=${oldest})
        set_property(SOURCE host/run/backends.cpp APPEND PROPERTY COMPILE_DEFINITIONS HOPSCOTCH_HAS_CUDA)
        target_link_libraries(${target} PUBLIC CUDA::cudart_static)
        if(HOPSCOTCH_CUDA_FAST)
            set_source_files_properties(host/device/devices.cu PROPERTIES
                COMPILE_DEFINITIONS HOPSCOTCH_CUDA_FAST)
        endif()
    endif()
endfunction()
