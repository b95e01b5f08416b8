// The entry of libFuzzer, which the preset `fuzz` builds.

#include <cstddef>
#include <cstdint>

#include "fuzz/input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    quadrille::fuzz::tryInput({reinterpret_cast<const char*>(data), size});
    return 0;
}
