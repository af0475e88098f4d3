// SCPI heads over USBTMC: those that return Psi and Delta, and those that return intensities.
//
// Verified against virtual instruments.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/instruments/scpi_commands.h"
#include "device/psi_delta_head.h"
#include "device/spectrometer.h"
#include "device/usb/usb_port.h"

namespace drude {

// Rows from the numbers that `psi_delta` answers. How many make a row follows from the number of
// wavelengths: 3, 5 or 6 (scpi_commands.h). Wavelengths that were not measured (Psi or Delta NaN)
// are left out; a sigma or depolarization that is NaN is not known. Throws DeviceError (bad_frame)
// for another count, other wavelengths, and what MeasurementRow's bounds forbid.
std::vector<MeasurementRow> scpi_rows(const std::vector<double>& numbers,
                                      const std::vector<double>& wavelengths_nm,
                                      double incidence_deg, const std::string& where);

// Counts from the numbers that `spectrum` answers, rounded; above `max_counts` they become that.
// Throws DeviceError (bad_frame) for another count and for what no detector counts.
std::vector<uint32_t> scpi_counts(const std::vector<double>& numbers, size_t pixels,
                                  uint32_t max_counts, const std::string& where);

std::shared_ptr<PsiDeltaHead> open_scpi_head(std::shared_ptr<UsbPort> port,
                                             const ScpiCommands& commands = {});
std::shared_ptr<Spectrometer> open_scpi_spectrometer(std::shared_ptr<UsbPort> port,
                                                     const ScpiCommands& commands = {});

}  // namespace drude
