# What every target of the project is compiled with.
add_library(quadrille_compiler INTERFACE)
target_compile_features(quadrille_compiler INTERFACE cxx_std_20)
if(MSVC)
  target_compile_options(quadrille_compiler INTERFACE /W4 /fp:precise)
else()
  # No contraction: a fused multiply-add rounds once where the contract says twice.
  target_compile_options(quadrille_compiler INTERFACE $<$<COMPILE_LANGUAGE:CXX>:
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-float-conversion
    -ffp-contract=off -fno-math-errno -fno-trapping-math -fopenmp-simd>)
  # g++ up to 13 sees overlapping copies, and copies beyond the end, in any "text" + std::string (its bugs
  # 105651 and 105329).
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
    target_compile_options(quadrille_compiler INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread>)
  endif()
  # clang warns of each loop that it does not vectorise as asked, and of '&' and '|' that save a branch.
  if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    target_compile_options(quadrille_compiler INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-pass-failed>)
    if(NOT CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
      target_compile_options(quadrille_compiler INTERFACE
        $<$<COMPILE_LANGUAGE:CXX>:-Wno-bitwise-instead-of-logical>)
    endif()
  endif()
endif()
# Each operation must round to the type of its operands. On 32-bit x86 that needs SSE2; a processor that
# has none, or a compiler that keeps more digits for other reasons, has other bits and is refused.
include(CheckCXXSourceCompiles)
check_cxx_source_compiles("__extension__ using Wide = __int128; int main() { return int(Wide(0)); }"
                          QUADRILLE_INT128)
if(NOT MSVC)
  set(rounds_each "#include <cfloat>\n#if FLT_EVAL_METHOD != 0\n#error more digits\n#endif\nint main() {}")
  check_cxx_source_compiles("${rounds_each}" QUADRILLE_ROUNDS_EACH)
  if(NOT QUADRILLE_ROUNDS_EACH)
    set(CMAKE_REQUIRED_FLAGS "-msse2 -mfpmath=sse")
    check_cxx_source_compiles("${rounds_each}" QUADRILLE_ROUNDS_EACH_WITH_SSE)
    unset(CMAKE_REQUIRED_FLAGS)
    if(NOT QUADRILLE_ROUNDS_EACH_WITH_SSE)
      message(FATAL_ERROR "This compiler evaluates with more digits than a type has (FLT_EVAL_METHOD)")
    endif()
    target_compile_options(quadrille_compiler INTERFACE -msse2 -mfpmath=sse)
  endif()
  unset(rounds_each)
endif()
if(QUADRILLE_NATIVE AND NOT MSVC)
  target_compile_options(quadrille_compiler INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-march=native>)
  # g++ would fetch the bodies of pairs by gather instructions, which are slower than loads one by one.
  include(CheckCXXCompilerFlag)
  set(no_gather -mtune-ctrl=^use_gather_2parts,^use_gather_4parts,^use_gather)
  check_cxx_compiler_flag(${no_gather} QUADRILLE_NO_GATHER)
  if(QUADRILLE_NO_GATHER)
    target_compile_options(quadrille_compiler INTERFACE $<$<COMPILE_LANGUAGE:CXX>:${no_gather}>)
  endif()
endif()
if(QUADRILLE_WARNINGS_AS_ERRORS)
  target_compile_options(quadrille_compiler INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:$<IF:$<CXX_COMPILER_ID:MSVC>,/WX,-Werror>>)
endif()
if(QUADRILLE_SANITIZE)
  target_compile_options(quadrille_compiler INTERFACE
    -fsanitize=${QUADRILLE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(quadrille_compiler INTERFACE -fsanitize=${QUADRILLE_SANITIZE})
endif()
