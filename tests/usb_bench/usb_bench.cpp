// usb-bench: runs a program on virtual USB devices. bench_options.cpp has its help.

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "device/virtual/virtual_bench.h"
#include "materials/material.h"
#include "usb_bench/bench_options.h"
#include "usb_bench/client.h"
#include "usb_bench/make_devices.h"
#include "usb_bench/usb_testbed.h"

namespace drude::usb_bench {

namespace {

constexpr int left_something = 125, hung = 124;

// The bench file of the devices (device/sweep/bench_file.h), with the calibration that the settings
// amount to beside it.
void write_bench_file(const BenchOptions& options) {
    const auto find = [&](const std::string& scheme) -> const DeviceOption* {
        for (const DeviceOption& device : options.devices) {
            if (device.scheme == scheme) return &device;
        }
        return nullptr;
    };
    nlohmann::ordered_json bench = {{"format", "drude-bench/1"}, {"name", "virtual USB bench"}};
    if (const DeviceOption* device = find("ooi")) bench["spectrometer"] = "ooi:" + device->serial;
    if (const DeviceOption* device = find("obp")) bench["spectrometer"] = "obp:" + device->serial;
    if (const DeviceOption* device = find("ell")) {
        const std::string uri = "ell:" + device->serial;
        bench["polariser"] = {{"rotator", uri + "/0"}};
        if (options.fixed_analyser_deg) {
            bench["analyser"] = {{"fixed_deg", *options.fixed_analyser_deg}};
        } else {
            bench["analyser"] = {{"rotator", uri + "/1"}};
            bench["retarder"] = {{"rotator", uri + "/2"}, {"in_deg", 0}, {"out_deg", 90}};
        }
    }
    const DeviceOption *sample = find("apt-sample"), *arm = find("apt-arm");
    if (sample != nullptr && arm != nullptr) {
        bench["goniometer"] = {{"sample", {{"rotator", "apt:" + sample->serial}}},
                               {"arm", {{"rotator", "apt:" + arm->serial}}}};
    } else {
        bench["goniometer"] = {{"fixed_deg", options.incidence_deg}};
    }
    const std::filesystem::path path = options.bench_file;
    const std::string calibration = path.stem().string() + "-calibration.json";
    bench["calibration"] = calibration;
    write_file((path.parent_path() / calibration).string(),
               format_calibration(true_calibration(options.settings)));
    write_file(options.bench_file, bench.dump(1) + "\n");
}

// Kills the client at an answer; it is known only once it runs.
class Killer {
  public:
    explicit Killer(FaultPlan& faults) {
        faults.on_kill = [this](int milliseconds) { start(milliseconds); };
    }
    ~Killer() {
        if (thread_.joinable()) thread_.join();
    }
    void aim(pid_t pid) { pid_ = pid; }

  private:
    void start(int milliseconds) {
        if (thread_.joinable()) return;
        thread_ = std::thread([pid = pid_, milliseconds] {
            std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
            kill(pid, SIGKILL);
        });
    }
    pid_t pid_ = 0;
    std::thread thread_;
};

// What the testbed hears of closed descriptors comes through sockets: a moment later.
std::vector<std::string> held_in_the_end(UsbTestbed& bed) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(2);
    std::vector<std::string> held = bed.held();
    while (!held.empty() && std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        held = bed.held();
    }
    return held;
}

// Whether a node can vanish between being listed and being opened.
bool may_miss_nodes(const BenchOptions& options) {
    return std::any_of(options.faults.begin(), options.faults.end(), [](const PlannedFault& fault) {
        return fault.kind == FaultKind::unplug || fault.kind == FaultKind::replug;
    });
}

// A node that the client left open shows as a descriptor of the node itself, besides the socket of
// the preload library; a socket alone is one of those that the library keeps.
void forget_sockets(std::vector<std::string>* left_over, std::vector<std::string>* held) {
    const auto is_socket = [](const std::string& one) {
        return one.find(" of socket:") != std::string::npos;
    };
    const bool node_open =
        std::any_of(left_over->begin(), left_over->end(), [&](const std::string& one) {
            return one.rfind("descriptor ", 0) == 0 && !is_socket(one);
        });
    if (node_open) return;
    const auto is_count = [](const std::string& one) {
        return one.size() > 12 && one.compare(one.size() - 12, 12, " descriptors") == 0;
    };
    left_over->erase(std::remove_if(left_over->begin(), left_over->end(), is_socket),
                     left_over->end());
    held->erase(std::remove_if(held->begin(), held->end(), is_count), held->end());
}

ClientRun run(const std::vector<std::string>& command, const BenchOptions& options, UsbTestbed& bed,
              Killer& killer) {
    ClientOptions client;
    client.seconds_allowed = options.seconds_allowed;
    client.inspect = options.inspect;
    client.device_root = bed.root();
    for (const DeviceOption& device : options.devices) {
        client.drop_override = client.drop_override || device.refused;
    }
    client.on_start = [&](pid_t pid) { killer.aim(pid); };
    std::vector<std::string> held;
    // The preload library keeps a socket for every node that could not be opened.
    if (client.drop_override) client.inspect = false;
    if (!client.drop_override) client.at_exit = [&] { held = held_in_the_end(bed); };
    ClientRun result = run_client(command, client);
    if (may_miss_nodes(options)) forget_sockets(&result.left_over, &held);
    if (result.exited) {
        result.left_over.insert(result.left_over.end(), held.begin(), held.end());
    } else {
        bed.client_died();
    }
    return result;
}

int work(const BenchOptions& options) {
    FaultPlan faults;
    for (const PlannedFault& fault : options.faults) faults.add(fault);
    OpticalBench optics(find_material(options.material), options.settings, options.frozen_noise);
    const auto devices = make_devices(options, optics, faults);
    UsbTestbed bed;
    for (size_t i = 0; i < devices.size(); ++i) {
        bed.plug(*devices[i], {options.devices[i].refused, options.devices[i].busy});
    }
    if (!options.bench_file.empty()) write_bench_file(options);
    Killer killer(faults);
    nlohmann::ordered_json report;
    std::vector<std::string> troubles;
    int status = 0;
    uint64_t answers_of_first = 0;
    for (const std::vector<std::string>* command : {&options.command, &options.on_failure}) {
        const bool second = command == &options.on_failure;
        if (second) {
            if (status == 0 || options.on_failure.empty()) break;
            {
                const std::lock_guard guard(bed.lock());
                faults.clear();
                for (const auto& device : devices) device->repair();
            }
            bed.plug_all_in();
        }
        const ClientRun result = run(*command, options, bed, killer);
        status = result.hung ? hung : result.status;
        for (const std::string& one : result.left_over) troubles.push_back("left behind: " + one);
        if (result.hung) troubles.push_back("hung");
        report[second ? "status_of_second" : "status"] = status;
        if (!second) answers_of_first = faults.count();
    }
    for (const std::string& one : bed.complaints()) troubles.push_back(one);
    report["answers"] = answers_of_first;
    report["faults_applied"] = faults.applied();
    report["not_applicable"] = faults.not_applicable();
    report["drivers_detached"] = bed.detached_count();
    report["troubles"] = troubles;
    if (!options.report_file.empty()) write_file(options.report_file, report.dump(1) + "\n");
    if (!options.answers_file.empty()) {
        write_file(options.answers_file, fmt::format("{}\n", fmt::join(faults.answers(), "\n")));
    }
    if (options.count) fmt::print(stderr, "usb-bench: {} answers\n", answers_of_first);
    for (const std::string& one : troubles) fmt::print(stderr, "usb-bench: {}\n", one);
    if (status == hung) return hung;
    return troubles.empty() ? status : left_something;
}

// udev's view of the machine is mocked by a preload library, for this process as well: it makes the
// events of plugging through libudev. Started again once to have it.
void start_under_preload(char** arguments) {
    constexpr const char* mark = "USB_BENCH_PRELOADED";
    if (std::getenv(mark) != nullptr) return;
    const char* before = std::getenv("LD_PRELOAD");
    std::string libraries = "libumockdev-preload.so.0";
    if (before != nullptr && *before != '\0') libraries = std::string(before) + ":" + libraries;
    setenv(mark, "1", 1);
    setenv("LD_PRELOAD", libraries.c_str(), 1);
    execv("/proc/self/exe", arguments);
    outside_error("cannot start again under umockdev's preload library: {}", std::strerror(errno));
}

}  // namespace

}  // namespace drude::usb_bench

int main(int argc, char** argv) {
    using namespace drude;
    try {
        const usb_bench::BenchOptions options =
            usb_bench::parse_bench_options({argv + 1, argv + argc});
        usb_bench::start_under_preload(argv);
        return usb_bench::work(options);
    } catch (const Error& error) {
        fmt::print(stderr, "usb-bench: {}\n", error.message());
        return static_cast<int>(error.cause());
    }
}
