// The commands that an SCPI head is asked with. Heads differ; the defaults are the set that this
// project documents, and a bench file may put others in their place.
#pragma once

#include <string>
#include <vector>

#include "device/instruments/scpi_format.h"

namespace drude {

struct ScpiCommands {
    std::string identity = "*IDN?";
    std::string clear_status = "*CLS";
    // Read until it says 0; empty: the head keeps no such queue.
    std::string next_error = "SYST:ERR?";
    // Answers 1 when what was commanded is done; empty: nothing to wait for.
    std::string done = "*OPC?";
    // Sent once after opening, e.g. "FORM REAL,64" together with `format`.
    std::vector<std::string> setup;
    ScpiFormat format = ScpiFormat::ascii;
    bool swapped = false;  // floats least significant byte first

    // Nanometres in vacuum, ascending.
    std::string wavelengths = "SENS:WAV?";

    // Heads that return Psi and Delta. {} stands for the angle of incidence in degrees.
    std::string angle = "SOUR:ANG {}";
    // Rows in the order of the wavelengths, one number after the other: wavelength, psi, delta, or
    // these and sigma_psi, sigma_delta, or these and depolarization; degrees.
    std::string psi_delta = "MEAS:PSID?";

    // Heads that return intensities. {} stands for the integration time in seconds.
    std::string integration = "SENS:INT {}";
    // A new exposure: as many counts as wavelengths. TRAC? would return the last one again.
    std::string spectrum = "MEAS:SPEC?";
    // {} stands for 1 or 0; empty: no lamp or shutter.
    std::string lamp;
    double shortest_s = 1e-3, longest_s = 60;
    uint32_t max_counts = 65535;
};

// `command` with {} replaced by `value`; throws Error (user) where it has none.
std::string scpi_command(const std::string& command, const std::string& value);

}  // namespace drude
