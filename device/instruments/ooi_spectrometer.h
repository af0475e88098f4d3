// Ocean Optics spectrometers of the OOI protocol: USB2000(+), USB4000 / Flame, HR2000(+), HR4000,
// QE65000, Maya, NIRQuest, Jaz.
#pragma once

#include <memory>
#include <string>

#include "device/bench_clock.h"
#include "device/spectrometer.h"
#include "device/usb/usb_port.h"

namespace drude {

// Drops what an earlier program left unread, initialises the device and reads its calibration; a
// fault that may pass is met with recovery and two more attempts. The lamp line stays as it was.
// `clock` stamps the frames and must outlive the spectrometer. Throws DeviceError; Error (user) for
// a product that is no OOI spectrometer.
std::shared_ptr<Spectrometer> open_ooi(std::shared_ptr<UsbPort> port,
                                       BenchClock& clock = real_clock());

// The serial number in memory slot 0, for devices whose USB descriptor has none; empty for other
// products. Throws DeviceError.
std::string ask_ooi_serial(UsbPort& port);

}  // namespace drude
