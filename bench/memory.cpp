#include "bench/memory.hpp"

#include <cstdlib>
#include <fstream>

#if defined(__linux__)
#include <unistd.h>
#endif
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace quadrille::bench {

std::optional<std::size_t> residentBytes() {
#if defined(__linux__)
    std::ifstream file("/proc/self/statm");
    std::size_t total = 0, resident = 0;
    if (file >> total >> resident) {
        return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    }
#endif
    return {};
}

void releaseFreedMemory() {
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
}

}  // namespace quadrille::bench
