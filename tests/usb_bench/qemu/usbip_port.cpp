#include "usb_bench/qemu/usbip_port.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/error.h"

namespace drude::usb_bench {

namespace {

namespace fs = std::filesystem;

const char* const controller = "/sys/devices/platform/vhci_hcd.0";

// From the moment at which a model leaves the bus until the kernel sees it: long enough that the
// host waits for an answer by then.
constexpr auto wait_for_pull = std::chrono::milliseconds(50);

// The folder of the controller's high-speed bus, "usb1": the one whose root hub is no SuperSpeed
// one.
fs::path high_speed_bus() {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(controller, ignored)) {
        const std::string name = entry.path().filename();
        if (name.rfind("usb", 0) != 0) continue;
        char speed[8] = {};
        const int file = open((entry.path() / "speed").c_str(), O_RDONLY | O_CLOEXEC);
        if (file < 0) continue;
        const bool read_it = read(file, speed, sizeof speed - 1) > 0;
        close(file);
        if (read_it && std::strncmp(speed, "480", 3) == 0) return entry.path();
    }
    return {};
}

}  // namespace

bool UsbipPort::attach() {
    int pair[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0) {
        outside_error("no socket pair for USB/IP: {}", std::strerror(errno));
    }
    const std::string path = std::string(controller) + "/attach";
    const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    const int opening = errno;
    // Port, socket, an identifier of the far machine's choice (bus and device number), and the
    // speed as include/uapi/linux/usb/ch9.h counts it.
    const int speed = device_.identity().high_speed ? 3 : 2;
    const std::string line =
        fmt::format("{} {} {} {}", number_, pair[1], 1 << 16 | (number_ + 1), speed);
    const bool written =
        file >= 0 && write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size());
    const int reason = file < 0 ? opening : errno;
    if (file >= 0) close(file);
    close(pair[1]);
    if (!written) {
        close(pair[0]);
        // A port is in use until the disconnection of its last device has gone through.
        if (file >= 0 && (reason == EAGAIN || reason == EBUSY)) return false;
        outside_error("{}: {}; expected the kernel module vhci_hcd, and to be root", path,
                      std::strerror(reason));
    }
    socket_ = pair[0];
    reader_ = {};
    pulled_.reset();
    return true;
}

void UsbipPort::detach() {
    if (socket_ < 0) return;
    shutdown(socket_, SHUT_RDWR);
    close(socket_);
    socket_ = -1;
    for (const uint64_t cookie : under_way_) device_.forget(cookie);
    under_way_.clear();
    taken_back_.clear();
}

void UsbipPort::serve() {
    char piece[16384];
    while (socket_ >= 0) {
        const ssize_t size = recv(socket_, piece, sizeof piece, MSG_DONTWAIT);
        if (size > 0) {
            reader_.append({piece, static_cast<size_t>(size)});
        } else if (size < 0 && errno == EINTR) {
            continue;
        } else if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
            break;
        } else {
            detach();  // the kernel has let go of the device
        }
    }
    while (socket_ >= 0) {
        const std::optional<UsbipCommand> command = reader_.next();
        if (!command) break;
        ++commands_;
        obey(*command);
    }
    answer();
    if (!device_.gone()) return;
    if (!pulled_) pulled_ = Clock::now() + wait_for_pull;
    if (Clock::now() >= *pulled_) detach();
}

void UsbipPort::obey(const UsbipCommand& command) {
    if (command.kind == UsbipCommand::Kind::unlink) {
        const bool waiting = device_.cancel(command.victim);
        if (waiting) {
            taken_back_.insert(command.victim);
        } else {
            // It was answered: the kernel must have that answer first, for after this one it no
            // longer knows the transfer.
            answer();
        }
        send(format_usbip_unlinked(command.sequence, waiting ? -ECONNRESET : 0));
        return;
    }
    Transfer transfer;
    transfer.cookie = command.sequence;
    transfer.type = command.endpoint == 0 ? TransferType::control : TransferType::bulk;
    transfer.endpoint = static_cast<uint8_t>(command.endpoint | (command.incoming ? 0x80 : 0));
    transfer.setup = command.setup;
    transfer.length = command.length;
    transfer.data = command.data;
    under_way_.insert(transfer.cookie);
    device_.submit(std::move(transfer));
}

void UsbipPort::answer() {
    while (socket_ >= 0) {
        const std::optional<Transfer> transfer = device_.reap();
        if (!transfer) return;
        under_way_.erase(transfer->cookie);
        if (taken_back_.erase(transfer->cookie) != 0) continue;
        const auto sequence = static_cast<uint32_t>(transfer->cookie);
        if (device_.gone()) {
            if (!transfer->incoming()) send(format_usbip_answer(sequence, 0, transfer->length, ""));
            continue;
        }
        if (transfer->incoming()) {
            send(format_usbip_answer(sequence, transfer->status, transfer->data.size(),
                                     transfer->data));
        } else {
            const size_t taken = transfer->status == 0 ? transfer->length : 0;
            send(format_usbip_answer(sequence, transfer->status, taken, ""));
        }
    }
}

void UsbipPort::send(const std::string& bytes) {
    size_t sent = 0;
    while (socket_ >= 0 && sent < bytes.size()) {
        const ssize_t size =
            ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
        if (size > 0) {
            sent += static_cast<size_t>(size);
        } else if (errno != EINTR) {
            detach();
        }
    }
}

std::string UsbipPort::interface_folder() const {
    const fs::path bus = high_speed_bus();
    if (bus.empty()) return "";
    // Bus 1, port 3, configuration 1, interface 0: "1-3:1.0".
    const std::string device = fmt::format("{}-{}", bus.filename().string().substr(3), number_ + 1);
    return bus / device / (device + ":1.0");
}

std::string UsbipPort::bound_driver() const {
    std::error_code none;
    const fs::path link = fs::read_symlink(fs::path(interface_folder()) / "driver", none);
    return none ? "" : link.filename().string();
}

bool UsbipPort::ready() const {
    std::error_code ignored;
    if (!attached() || !fs::exists(interface_folder(), ignored)) return false;
    return bound_driver() == device_.identity().kernel_driver;
}

}  // namespace drude::usb_bench
