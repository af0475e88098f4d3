#include "device/usb/usb_transfer.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <thread>

#include "base/interrupt.h"

namespace drude {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::microseconds;

constexpr microseconds slice = std::chrono::milliseconds(50);

void LIBUSB_CALL on_completion(libusb_transfer* transfer) {
    *static_cast<int*>(transfer->user_data) = 1;
}

TransferEnd end_of(libusb_transfer_status status, TransferEnd when_cancelled) {
    switch (status) {
        case LIBUSB_TRANSFER_COMPLETED:
            return TransferEnd::complete;
        case LIBUSB_TRANSFER_CANCELLED:
            return when_cancelled;
        case LIBUSB_TRANSFER_TIMED_OUT:
            return TransferEnd::timed_out;
        case LIBUSB_TRANSFER_STALL:
            return TransferEnd::stalled;
        case LIBUSB_TRANSFER_OVERFLOW:
            return TransferEnd::overflow;
        case LIBUSB_TRANSFER_NO_DEVICE:
            return TransferEnd::unplugged;
        case LIBUSB_TRANSFER_ERROR:
            break;
    }
    return TransferEnd::failed;
}

}  // namespace

UsbTransfer::UsbTransfer(size_t buffer_bytes)
    : transfer_(libusb_alloc_transfer(0)), buffer_(buffer_bytes) {
    if (!transfer_) throw std::bad_alloc();
    transfer_->user_data = &completed_;
    transfer_->callback = on_completion;
}

UsbTransfer::~UsbTransfer() {
    libusb_free_transfer(transfer_);
}

TransferEnd UsbTransfer::run(libusb_context* context, Deadline deadline) {
    if (interrupted() != 0) deadline = std::min(deadline, deadline_in(1));
    const int signal_before = interrupted();
    completed_ = 0;
    submission_ = libusb_submit_transfer(transfer_);
    if (submission_ == LIBUSB_ERROR_NO_DEVICE) return TransferEnd::unplugged;
    if (submission_ != 0) return TransferEnd::failed;

    bool cancelled = false;
    TransferEnd when_cancelled = TransferEnd::timed_out;
    while (!completed_) {
        const Clock::time_point now = Clock::now();
        const bool signalled = interrupted() != signal_before;
        if (!cancelled && (signalled || now >= deadline)) {
            if (signalled) when_cancelled = TransferEnd::interrupted;
            libusb_cancel_transfer(transfer_);  // "not found": it has just ended by itself
            cancelled = true;
            deadline = now + std::chrono::seconds(1);  // for the kernel to give it back
        } else if (cancelled && now >= deadline) {
            in_flight_ = true;
            return when_cancelled;
        }
        const microseconds left = std::clamp(
            std::chrono::duration_cast<microseconds>(deadline - now), microseconds(0), slice);
        timeval timeout{};
        timeout.tv_usec = static_cast<suseconds_t>(left.count());
        const int status = libusb_handle_events_timeout_completed(context, &timeout, &completed_);
        // Whatever libusb cannot wait for, the deadline still holds.
        if (status < 0 && status != LIBUSB_ERROR_INTERRUPTED) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    return end_of(transfer_->status, when_cancelled);
}

}  // namespace drude
