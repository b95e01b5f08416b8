#include "system/memory.hpp"

#include <algorithm>
#include <limits>

#ifdef _WIN32
#define NOMINMAX
#include <windows.h>
#else
#include <sys/resource.h>
#include <unistd.h>
#endif

#ifdef __linux__
#include <filesystem>
#include <fstream>
#include <string>
#endif

namespace quadrille {

namespace {

constexpr std::uint64_t unknown = std::numeric_limits<std::uint64_t>::max();

std::uint64_t physicalMemory() {
#if defined(_WIN32)
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof status;
    return GlobalMemoryStatusEx(&status) ? status.ullTotalPhys : unknown;
#elif defined(_SC_PHYS_PAGES)
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long bytes = sysconf(_SC_PAGESIZE);
    if (pages <= 0 || bytes <= 0) return unknown;
    return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(bytes);
#else
    return unknown;
#endif
}

std::uint64_t resourceLimit() {
    std::uint64_t least = unknown;
#ifndef _WIN32
    for (const auto resource : {RLIMIT_AS, RLIMIT_DATA}) {
        rlimit limit{};
        if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) continue;
        least = std::min(least, static_cast<std::uint64_t>(limit.rlim_cur));
    }
#endif
    return least;
}

#ifdef __linux__
/// The least limit on the way from a group to the root of its hierarchy; "max" is none.
std::uint64_t groupLimit(const std::filesystem::path& root, std::string group, const char* file) {
    std::uint64_t least = unknown;
    while (true) {
        std::ifstream in(root / group.substr(group.starts_with('/') ? 1 : 0) / file);
        std::uint64_t bytes = 0;
        if (in >> bytes) least = std::min(least, bytes);
        const std::size_t parent = group.rfind('/');
        if (group.size() <= 1 || parent == std::string::npos) return least;
        group.erase(parent);
    }
}
#endif

std::uint64_t controlGroupLimit() {
    std::uint64_t least = unknown;
#ifdef __linux__
    // Lines such as 0::/user.slice (version 2) and 4:memory:/user.slice (version 1).
    std::ifstream groups("/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const std::string group = line.substr(second + 1);
        if (controllers.empty()) {
            least = std::min(least, groupLimit("/sys/fs/cgroup", group, "memory.max"));
        } else if (controllers == "memory") {
            least = std::min(least,
                             groupLimit("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
        }
    }
#endif
    return least;
}

}  // namespace

std::uint64_t memoryOfMachine() {
    return std::min({physicalMemory(), resourceLimit(), controlGroupLimit()});
}

}  // namespace quadrille
