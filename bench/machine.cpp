#include "bench/machine.hpp"

#include <cctype>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <thread>

#include <quadrille/device.hpp>
#include <quadrille/version.hpp>

namespace quadrille::bench {

namespace {

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with("model name")) continue;
        const auto colon = line.find(": ");
        if (colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown";
}

std::string loadAverage() {
    std::ifstream file("/proc/loadavg");
    std::string lastMinute;
    return file >> lastMinute ? lastMinute : "unknown";
}

/// The CUDA device and its driver, as "NVIDIA H200, driver 580.159.04".
std::string device() {
    const CudaDevice device = findCudaDevice();
    if (!device.usable()) return "none";
    // "NVRM version: NVIDIA UNIX Open Kernel Module for x86_64  580.159.04  Release Build ..."
    std::ifstream file("/proc/driver/nvidia/version");
    for (std::string word; file >> word;) {
        const bool number = !word.empty() && std::isdigit(static_cast<unsigned char>(word[0])) != 0;
        if (number && word.find('.') != std::string::npos) return device.name + ", driver " + word;
    }
    return device.name + ", driver unknown";
}

std::string compiler() {
#if defined(__clang__)
    return __VERSION__;
#elif defined(__GNUC__)
    return "GCC " __VERSION__;
#elif defined(_MSC_VER)
    return "MSVC " + std::to_string(_MSC_VER);
#else
    return "unknown";
#endif
}

std::string now() {
    using namespace std::chrono;
    const auto time = floor<seconds>(system_clock::now());
    const auto day = floor<days>(time);
    const year_month_day date(day);
    const hh_mm_ss clock(time - day);
    char text[32];
    std::snprintf(text, sizeof text, "%04d-%02u-%02u %02d:%02d UTC", static_cast<int>(date.year()),
                  static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                  static_cast<int>(clock.hours().count()),
                  static_cast<int>(clock.minutes().count()));
    return text;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> describeMachine() {
    return {
        {"cpu", processor()},     {"cores", std::to_string(std::thread::hardware_concurrency())},
        {"load", loadAverage()},  {"device", device()},
        {"compiler", compiler()}, {"build", QUADRILLE_BUILD},
        {"version", version},     {"commit", commit()},
        {"date", now()}};
}

}  // namespace quadrille::bench
