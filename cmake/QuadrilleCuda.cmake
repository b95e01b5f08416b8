# What device code is compiled with. Its architecture is that of the GPU machine unless said
# otherwise with CMAKE_CUDA_ARCHITECTURES.
if(NOT DEFINED CMAKE_CUDA_ARCHITECTURES)
  set(CMAKE_CUDA_ARCHITECTURES 90)
endif()
enable_language(CUDA)
find_package(CUDAToolkit REQUIRED)
# -std: CMake 3.25 does not know that this compiler speaks C++20.
# The physics rounds on the device as on the host: no contraction, IEEE division and square root.
target_compile_options(quadrille_compiler INTERFACE $<$<COMPILE_LANGUAGE:CUDA>:
  -std=c++20 -fmad=false -prec-div=true -prec-sqrt=true -ftz=false
  -Xcompiler=-Wall,-Wextra,-ffp-contract=off -diag-suppress=20012>)
if(QUADRILLE_WARNINGS_AS_ERRORS)
  target_compile_options(quadrille_compiler INTERFACE
    $<$<COMPILE_LANGUAGE:CUDA>:-Werror=all-warnings>)
endif()
