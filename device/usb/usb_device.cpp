#include "device/usb/usb_device.h"

#include <algorithm>
#include <utility>

#include "base/interrupt.h"
#include "device/bench_clock.h"
#include "device/device_error.h"
#include "device/usb/usb_fault.h"
#include "device/usb/usb_handles.h"
#include "device/usb/usb_holder.h"
#include "device/usb/usb_search.h"
#include "device/usb/usb_transfer.h"

namespace drude {

namespace {

using Clock = std::chrono::steady_clock;

class LibusbPort : public UsbPort {
  public:
    // Searches, opens and claims; throws as open_usb().
    explicit LibusbPort(const UsbTarget& target) : target_(target) { open(); }
    // Claims a device that was found and opened already, to ask it for its serial number.
    LibusbPort(libusb_context* context, const UsbTarget& target, UsbCandidate&& candidate)
        : target_(target), borrowed_context_(context) {
        adopt(std::move(candidate));
    }
    ~LibusbPort() override { close(); }
    LibusbPort(const LibusbPort&) = delete;
    LibusbPort& operator=(const LibusbPort&) = delete;

    std::string name() const override { return name_; }
    std::string serial() const override { return serial_; }
    uint16_t vendor() const override { return vendor_; }
    uint16_t product() const override { return product_; }
    bool high_speed() const override { return high_speed_; }
    uint8_t interface_number() const override { return static_cast<uint8_t>(interface_.number); }
    size_t packet_size(uint8_t endpoint) const override {
        const auto found = interface_.endpoints.find(endpoint);
        return found == interface_.endpoints.end() ? 0 : found->second.packet_size;
    }
    std::vector<std::pair<uint8_t, uint8_t>> endpoints() const override {
        std::vector<std::pair<uint8_t, uint8_t>> result;
        for (const auto& [address, end] : interface_.endpoints) {
            result.emplace_back(address, end.type);
        }
        return result;
    }

    void write(uint8_t endpoint, std::span<const uint8_t> bytes, Deadline deadline) override {
        auto transfer = std::make_unique<UsbTransfer>(bytes.size());
        std::copy(bytes.begin(), bytes.end(), transfer->buffer().begin());
        size_t done = 0;
        const TransferEnd end = run_data(endpoint, std::move(transfer), deadline, &done, nullptr);
        const std::string what = fmt::format("writing to endpoint {:02x}", endpoint);
        if (end != TransferEnd::complete) raise(end, what, done, bytes.size());
        if (done != bytes.size()) raise(TransferEnd::failed, what, done, bytes.size());
    }

    size_t read(uint8_t endpoint, std::span<uint8_t> buffer, Deadline deadline) override {
        size_t done = 0;
        const TransferEnd end = run_data(endpoint, std::make_unique<UsbTransfer>(buffer.size()),
                                         deadline, &done, buffer.data());
        if (end != TransferEnd::complete) {
            raise(end, fmt::format("reading from endpoint {:02x}", endpoint), done, buffer.size());
        }
        return done;
    }

    void control_out(const ControlRequest& request, std::span<const uint8_t> data,
                     Deadline deadline) override {
        auto transfer = make_control(request, static_cast<uint16_t>(data.size()));
        std::copy(data.begin(), data.end(), transfer->buffer().begin() + LIBUSB_CONTROL_SETUP_SIZE);
        size_t done = 0;
        const TransferEnd end = run(std::move(transfer), deadline, &done, nullptr);
        if (end != TransferEnd::complete) raise_control(end, request, done, data.size());
    }

    std::vector<uint8_t> control_in(const ControlRequest& request, uint16_t length,
                                    Deadline deadline) override {
        std::vector<uint8_t> answer(length);
        size_t done = 0;
        const TransferEnd end = run(make_control(request, length), deadline, &done, answer.data());
        if (end != TransferEnd::complete) raise_control(end, request, done, length);
        answer.resize(done);
        return answer;
    }

    void clear_halt(uint8_t endpoint) override {
        const std::string what = fmt::format("clearing the halt of endpoint {:02x}", endpoint);
        if (!handle_) raise(TransferEnd::unplugged, what, 0, 0);
        const int status = libusb_clear_halt(handle_.get(), endpoint);
        if (status == LIBUSB_ERROR_NO_DEVICE) raise(TransferEnd::unplugged, what, 0, 0);
        if (status != 0) raise(TransferEnd::failed, what, 0, 0);
    }

    size_t drain(uint8_t endpoint, double quiet_s, Deadline deadline) override {
        const size_t room = 64 * packet_size(endpoint);
        if (room == 0) return 0;
        size_t dropped = 0;
        while (Clock::now() < deadline) {
            size_t done = 0;
            const TransferEnd end =
                run_data(endpoint, std::make_unique<UsbTransfer>(room),
                         std::min(deadline, deadline_in(quiet_s)), &done, nullptr);
            dropped += done;
            if (end == TransferEnd::timed_out) break;
            if (end != TransferEnd::complete && end != TransferEnd::overflow) {
                raise(end, fmt::format("draining endpoint {:02x}", endpoint), done, room);
            }
        }
        return dropped;
    }

    bool reopen(double seconds) override {
        close();
        const Deadline deadline = deadline_in(seconds);
        target_.serial = serial_;
        for (;;) {
            const bool last = Clock::now() >= deadline || interrupted() != 0;
            try {
                open();
                return true;
            } catch (const NoSuchDevice&) {
                if (last) return false;
            } catch (const DeviceError&) {
                if (last) return false;
            } catch (const Error&) {
                // udev grants access a moment after the device has appeared, and lets a kernel
                // driver take it before.
                if (last) throw;
            }
            real_clock().sleep(0.1);
        }
    }

  private:
    void open() {
        std::string problem;
        context_ = make_context(&problem);
        if (!context_) {
            throw NoSuchDevice(
                Cause::outside,
                fmt::format("no {} can be opened: this machine gives no access to USB ({})",
                            target_.what, problem));
        }
        libusb_context* context = context_.get();
        adopt(find_device(context, target_,
                          [&](UsbCandidate& candidate) { ask_serial(context, candidate); }));
    }

    // Claims the device, asks, and gives its handle back. A device that is busy or does not answer
    // keeps no other from being found.
    void ask_serial(libusb_context* context, UsbCandidate& candidate) const {
        if (!target_.ask_serial) return;
        try {
            LibusbPort port(context, target_, std::move(candidate));
            try {
                candidate.serial = target_.ask_serial(port);
                candidate.serial_problem.clear();
            } catch (const DeviceError& error) {
                if (error.fault() != Fault::unplugged) candidate.serial_problem = error.message();
            }
            libusb_release_interface(port.handle_.get(), port.interface_.number);
            if (!port.stuck_.empty()) {
                // The kernel writes into their buffers until the handle is closed.
                port.handle_.reset();
                libusb_device_handle* fresh = nullptr;
                candidate.open_status = libusb_open(port.device_.get(), &fresh);
                port.handle_.reset(fresh);
            }
            candidate.handle = std::move(port.handle_);
            candidate.device = std::move(port.device_);
        } catch (const NoSuchDevice&) {
            // It has just left.
        } catch (const Error& error) {
            candidate.serial_problem = error.message();
        }
    }

    void adopt(UsbCandidate&& candidate) {
        vendor_ = candidate.vendor;
        product_ = candidate.product;
        bus_ = candidate.bus;
        address_ = candidate.address;
        serial_ = candidate.serial;
        name_ = shown_device(target_.scheme, candidate);
        high_speed_ = libusb_get_device_speed(candidate.device.get()) >= LIBUSB_SPEED_HIGH;
        interface_ = choose_interface(candidate.device.get(), target_.scheme);
        const int status = claim(candidate.handle.get());
        if (status == LIBUSB_ERROR_NO_DEVICE) {
            throw NoSuchDevice(Cause::outside, name_ + ": it was unplugged while it was opened");
        }
        if (status == LIBUSB_ERROR_BUSY) {
            outside_error("{}: {}", name_, explain_busy(candidate.device.get(), interface_.number));
        }
        if (status != 0) {
            outside_error("{}: its interface {} could not be claimed ({})", name_,
                          interface_.number, libusb_strerror(status));
        }
        device_ = std::move(candidate.device);
        handle_ = std::move(candidate.handle);
    }

    int claim(libusb_device_handle* handle) const {
        libusb_set_auto_detach_kernel_driver(handle, 1);
        const int status = libusb_claim_interface(handle, interface_.number);
        if (status != LIBUSB_ERROR_OTHER && status != LIBUSB_ERROR_NOT_SUPPORTED) return status;
        // A system that lets nobody detach drivers; there may be none to detach.
        libusb_set_auto_detach_kernel_driver(handle, 0);
        return libusb_claim_interface(handle, interface_.number);
    }

    void close() {
        // Releasing attaches the kernel driver again; a device that is gone has none.
        if (handle_) libusb_release_interface(handle_.get(), interface_.number);
        handle_.reset();
        stuck_.clear();  // not before the handle: the kernel still writes into their buffers
        device_.reset();
        context_.reset();
    }

    libusb_context* context() const { return context_ ? context_.get() : borrowed_context_; }

    TransferEnd run_data(uint8_t endpoint, std::unique_ptr<UsbTransfer> transfer, Deadline deadline,
                         size_t* done, uint8_t* copy_to) {
        const auto found = interface_.endpoints.find(endpoint);
        if (found == interface_.endpoints.end()) {
            device_error(Fault::io, "{}: it has no endpoint {:02x}", name_, endpoint);
        }
        libusb_transfer* raw = transfer->get();
        raw->dev_handle = handle_.get();
        raw->endpoint = endpoint;
        raw->type = found->second.type;
        raw->buffer = transfer->buffer().data();
        raw->length = static_cast<int>(transfer->buffer().size());
        return run(std::move(transfer), deadline, done, copy_to);
    }

    std::unique_ptr<UsbTransfer> make_control(const ControlRequest& request, uint16_t length) {
        auto transfer = std::make_unique<UsbTransfer>(LIBUSB_CONTROL_SETUP_SIZE + length);
        libusb_fill_control_setup(transfer->buffer().data(), request.request_type, request.request,
                                  request.value, request.index, length);
        libusb_transfer* raw = transfer->get();
        raw->dev_handle = handle_.get();
        raw->endpoint = 0;
        raw->type = LIBUSB_TRANSFER_TYPE_CONTROL;
        raw->buffer = transfer->buffer().data();
        raw->length = static_cast<int>(transfer->buffer().size());
        return transfer;
    }

    // `copy_to` takes the data that came; *done is their number, also where the transfer failed.
    TransferEnd run(std::unique_ptr<UsbTransfer> transfer, Deadline deadline, size_t* done,
                    uint8_t* copy_to) {
        if (!handle_) return TransferEnd::unplugged;
        const TransferEnd end = transfer->run(context(), deadline);
        *done = transfer->transferred();
        if (transfer->in_flight()) {
            *done = 0;
            stuck_.push_back(std::move(transfer));
            return end;
        }
        if (copy_to && *done > 0) {
            const auto from =
                transfer->buffer().begin() + (transfer->get()->type == LIBUSB_TRANSFER_TYPE_CONTROL
                                                  ? LIBUSB_CONTROL_SETUP_SIZE
                                                  : 0);
            std::copy(from, from + static_cast<std::ptrdiff_t>(*done), copy_to);
        }
        return end;
    }

    [[noreturn]] void raise(TransferEnd end, const std::string& what, size_t done, size_t wanted) {
        raise_transfer(end, {name_, vendor_, product_, bus_, address_}, what, done, wanted);
    }

    [[noreturn]] void raise_control(TransferEnd end, const ControlRequest& request, size_t done,
                                    size_t wanted) {
        raise(end,
              fmt::format("control request {:02x} {:02x}", request.request_type, request.request),
              done, wanted);
    }

    UsbTarget target_;
    std::string name_, serial_;
    uint16_t vendor_ = 0, product_ = 0;
    int bus_ = 0, address_ = 0;
    bool high_speed_ = false;
    ChosenInterface interface_;
    libusb_context* borrowed_context_ = nullptr;
    // In this order, so that an exception in the constructor frees them the right way round.
    ContextPointer context_;
    std::vector<std::unique_ptr<UsbTransfer>> stuck_;
    DevicePointer device_;
    HandlePointer handle_;
};

}  // namespace

std::vector<UsbId> usb_ids(const std::string& scheme) {
    std::vector<UsbId> ids;
    for (const KnownInstrument& known : known_instruments()) {
        if (known.family.scheme == scheme) ids.push_back({known.vendor, known.product});
    }
    return ids;
}

std::shared_ptr<UsbPort> open_usb(const UsbTarget& target) {
    return std::make_shared<LibusbPort>(target);
}

}  // namespace drude
