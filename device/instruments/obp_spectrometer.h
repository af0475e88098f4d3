// Ocean Optics and Ocean Insight spectrometers of the Ocean Binary Protocol: STS, Spark, Ventana,
// HDX, QE Pro (OBP); SR2/4/6, HR2/4/6, ST (OBP2).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "device/bench_clock.h"
#include "device/instruments/obp_models.h"
#include "device/spectrometer.h"
#include "device/usb/usb_port.h"

namespace drude {

// Drops what an earlier program left unread and reads the device's calibration; a fault that may
// pass is met with recovery and two more attempts. `clock` stamps the frames and must outlive the
// spectrometer. Throws DeviceError; Error (user) for a product that is no OBP spectrometer.
std::shared_ptr<Spectrometer> open_obp(std::shared_ptr<UsbPort> port,
                                       BenchClock& clock = real_clock());

// The serial number that the device itself knows, for those whose USB descriptor has none; empty
// for other products. Throws DeviceError.
std::string ask_obp_serial(UsbPort& port);

// Counts of every pixel of the data of a spectrum message. Throws DeviceError (short_read,
// overflow) for a length that is not the model's.
std::vector<uint32_t> parse_obp_spectrum(std::span<const uint8_t> data, const ObpModel& model,
                                         const std::string& device);

}  // namespace drude
