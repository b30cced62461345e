# When kernels are compiled for GPUs: with AUTO where nvcc and a driver are, with ON where nvcc is, with OFF
# never; ON without nvcc is an error that says what to do. Usage: cmake -DSOURCE=DIR -P test_option.cmake
include(${SOURCE}/configs/cmake/HopscotchCudaChoice.cmake)

function(claim option nvcc driver expected)
    hopscotch_choose_cuda(got "${option}" "${nvcc}" "${driver}")
    if(NOT got STREQUAL expected)
        message(SEND_ERROR "${option} with nvcc '${nvcc}' and driver '${driver}': ${got}")
    endif()
endfunction()

claim(AUTO /opt/nvcc /opt/libcuda.so.1 ON)
claim(AUTO /opt/nvcc HOPSCOTCH_CUDA_DRIVER-NOTFOUND OFF)
claim(AUTO HOPSCOTCH_NVCC-NOTFOUND /opt/libcuda.so.1 OFF)
claim(AUTO "" "" OFF)
claim(ON /opt/nvcc "" ON)
claim(OFF /opt/nvcc /opt/libcuda.so.1 OFF)

if(DEFINED EXPECT_ERROR)
    hopscotch_choose_cuda(got ON HOPSCOTCH_NVCC-NOTFOUND "")
endif()
