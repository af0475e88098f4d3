#include "usb_bench/qemu/usbip_host.h"

#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/error.h"

namespace drude::usb_bench {

namespace {

// How late an answer may be: models are asked this often for packets whose time has come.
constexpr double tick_s = 1e-3;
// A driver that is bound still sets its device up; one that has asked nothing for so long is done.
constexpr double silence_s = 0.3;

Instant in_seconds(double seconds) {
    return Clock::now() + seconds_of(seconds);
}

}  // namespace

UsbipHost::UsbipHost(const std::vector<VirtualDevice*>& devices) {
    for (VirtualDevice* device : devices) {
        auto slot = std::make_unique<Slot>();
        slot->port = std::make_unique<UsbipPort>(*device, static_cast<int>(slots_.size()));
        Slot* const here = slot.get();
        device->on_unplug = [here](std::optional<int> milliseconds) {
            if (milliseconds) here->plug_in = in_seconds(*milliseconds / 1000.0);
        };
        slots_.push_back(std::move(slot));
    }
}

UsbipHost::~UsbipHost() {
    if (child_ > 0) {
        kill(child_, SIGKILL);
        waitpid(child_, nullptr, 0);
    }
    for (const auto& slot : slots_) slot->port->device().on_unplug = nullptr;
}

void UsbipHost::serve_for(double seconds) {
    std::vector<pollfd> sockets;
    for (const auto& slot : slots_) {
        // A negative descriptor is passed over.
        sockets.push_back({slot->port->descriptor(), POLLIN, 0});
    }
    poll(sockets.data(), sockets.size(), std::max(1, static_cast<int>(1000 * seconds)));
    for (const auto& slot : slots_) slot->port->serve();
}

void UsbipHost::plug_in_what_is_due() {
    for (const auto& slot : slots_) {
        if (!slot->plug_in || Clock::now() < *slot->plug_in) continue;
        slot->port->detach();
        if (slot->port->device().gone()) slot->port->device().plug_in();
        if (slot->port->attach()) slot->plug_in.reset();
    }
}

bool UsbipHost::all_ready() const {
    return std::all_of(slots_.begin(), slots_.end(), [](const std::unique_ptr<Slot>& slot) {
        return slot->port->device().gone() || slot->port->ready();
    });
}

uint64_t UsbipHost::commands() const {
    uint64_t sum = 0;
    for (const auto& slot : slots_) sum += slot->port->commands();
    return sum;
}

void UsbipHost::attach(double seconds) {
    for (const auto& slot : slots_) slot->plug_in = Clock::now();
    const Instant deadline = in_seconds(seconds);
    uint64_t heard = 0;
    Instant quiet = in_seconds(silence_s);
    while (!all_ready() || Clock::now() < quiet) {
        if (commands() != heard) {
            heard = commands();
            quiet = in_seconds(silence_s);
        }
        if (Clock::now() > deadline) {
            for (const auto& slot : slots_) {
                const Identity& identity = slot->port->device().identity();
                if (slot->port->ready()) continue;
                outside_error("{}: the kernel has not configured it after {} s, or '{}' has it",
                              identity.name, seconds, slot->port->bound_driver());
            }
            outside_error("the kernel's drivers still talk to the devices after {} s", seconds);
        }
        plug_in_what_is_due();
        serve_for(tick_s);
    }
}

int UsbipHost::run(const std::vector<std::string>& program, double seconds) {
    std::vector<char*> arguments;
    for (const std::string& word : program) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    std::fflush(nullptr);
    child_ = fork();
    if (child_ < 0) outside_error("no process for {}: {}", program[0], std::strerror(errno));
    if (child_ == 0) {
        execvp(arguments[0], arguments.data());
        std::perror(arguments[0]);
        _exit(127);
    }
    const Instant deadline = in_seconds(seconds);
    int status = 0;
    while (waitpid(child_, &status, WNOHANG) == 0) {
        if (Clock::now() > deadline) {
            kill(child_, SIGKILL);
            waitpid(child_, nullptr, 0);
            child_ = 0;
            outside_error("{} was still running after {} s", program[0], seconds);
        }
        if (kill_at_ && Clock::now() >= *kill_at_) {
            kill(child_, SIGKILL);
            kill_at_.reset();
        }
        plug_in_what_is_due();
        serve_for(tick_s);
    }
    child_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool UsbipHost::drivers_back(double seconds, std::string* problem) {
    const Instant deadline = in_seconds(seconds);
    while (!all_ready()) {
        if (Clock::now() > deadline) {
            for (const auto& slot : slots_) {
                const Identity& identity = slot->port->device().identity();
                if (slot->port->device().gone() || slot->port->ready()) continue;
                *problem +=
                    fmt::format("{}: expected its interface with driver '{}', found '{}'; ",
                                identity.name, identity.kernel_driver, slot->port->bound_driver());
            }
            return false;
        }
        plug_in_what_is_due();
        serve_for(tick_s);
    }
    return true;
}

}  // namespace drude::usb_bench
