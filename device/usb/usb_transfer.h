// One USB transfer with a deadline; inside device/usb/ only.
//
// libusb's blocking calls neither end at a signal nor tell a time-out with half an answer from one
// without, so transfers are submitted and events handled here, in the calling thread.
#pragma once

#include <libusb.h>

#include <cstdint>
#include <vector>

#include "device/usb/usb_port.h"

namespace drude {

enum class TransferEnd {
    complete,
    timed_out,
    interrupted,  // a signal asked the program to stop
    stalled,
    overflow,
    unplugged,
    failed,
};

class UsbTransfer {
  public:
    explicit UsbTransfer(size_t buffer_bytes);
    ~UsbTransfer();
    UsbTransfer(const UsbTransfer&) = delete;
    UsbTransfer& operator=(const UsbTransfer&) = delete;

    libusb_transfer* get() { return transfer_; }
    std::vector<unsigned char>& buffer() { return buffer_; }

    // Submits what was filled into get() and returns when it has ended. At the deadline, and where
    // a signal arrives meanwhile, it is cancelled; a transfer that starts after the signal gets at
    // most a second, so that a device can still be left in order. Handles events at most 50 ms at a
    // time.
    TransferEnd run(libusb_context* context, Deadline deadline);

    // Bytes that went over the bus, also where the transfer did not complete.
    size_t transferred() const { return static_cast<size_t>(transfer_->actual_length); }
    // The kernel did not give it back when it was cancelled: it must live until its device handle
    // is closed.
    bool in_flight() const { return in_flight_; }
    // libusb's status of a submission that failed, or 0.
    int submission() const { return submission_; }

  private:
    libusb_transfer* transfer_;
    std::vector<unsigned char> buffer_;
    int completed_ = 0;
    int submission_ = 0;
    bool in_flight_ = false;
};

}  // namespace drude
