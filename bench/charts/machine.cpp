#include "bench/charts/machine.h"

#include <ceres/version.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <fstream>

#include "base/executor.h"
#include "render/embree.h"

namespace drude {

namespace {

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return "unknown";
}

std::string system_name() {
    utsname name{};
    return uname(&name) == 0 ? fmt::format("{} {}", name.sysname, name.machine) : "unknown";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> machine_facts() {
    const double gigabytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                             static_cast<double>(sysconf(_SC_PAGE_SIZE)) * 1e-9;
#ifdef __clang__
    constexpr const char* compiler = "clang " __clang_version__;
#else
    constexpr const char* compiler = "g++ " __VERSION__;
#endif
    return {{"Date", fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)))},
            {"Processor", fmt::format("{}, {} in use", processor_name(), available_threads())},
            {"Memory", fmt::format("{:.0f} GB", gigabytes)},
            {"System", system_name()},
            {"drude", fmt::format("{} of commit {}, built for {}", DRUDE_VERSION, source_commit(),
                                  DRUDE_ISA)},
            {"Compiler", compiler},
            {"Libraries", "Embree " RTC_VERSION_STRING ", Ceres " CERES_VERSION_STRING}};
}

}  // namespace drude
