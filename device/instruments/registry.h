// Instruments by URI, in one place: what a bench file names is opened here.
//
//   ooi:SERIAL         Ocean Optics spectrometer, OOI protocol     obp:SERIAL   OBP and OBP2
//   ell:SERIAL/ADDRESS Thorlabs Elliptec mount, its bus address 0-F
//   apt:SERIAL         Thorlabs K10CR1
//   usbtmc:VID:PID:SERIAL   SCPI head; numbers in hexadecimal
//
// A serial number may be left out where only one device fits ("ooi:", "ell:/2").
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "device/instruments/scpi_commands.h"
#include "device/psi_delta_head.h"
#include "device/rotator.h"
#include "device/spectrometer.h"

namespace drude {

struct InstrumentUri {
    std::string scheme;                // "ooi"
    std::string serial;                // empty: the only one of its kind
    std::string address;               // of "ell"
    uint16_t vendor = 0, product = 0;  // of "usbtmc"
};

// Throws Error (user) with the schemes there are and the nearest one.
InstrumentUri parse_instrument_uri(const std::string& uri);

// What the driver of a scheme can play and needs, for `drude devices` and help.
struct InstrumentDriver {
    std::string scheme;
    std::string plays;         // "spectrometer", "rotator", "head or spectrometer"
    std::string what;          // "Ocean Optics USB2000+, USB4000/Flame-T, HR4000, QE65000"
    std::string capabilities;  // "intensities, lamp line, calibration from its memory"
};
const std::vector<InstrumentDriver>& instrument_drivers();

// What a device of these numbers can do under its scheme's driver: "3840 pixels, integration 10 us
// to 65.5 s, lamp line", or the driver's capabilities where the numbers say no more. Empty for a
// scheme without driver.
std::string instrument_capabilities(const std::string& scheme, uint16_t vendor, uint16_t product);

// Opens over libusb. Throws Error: (user) for a URI of another kind and where several devices fit
// and no serial says which, listing theirs; (outside) where there is none, where it is busy or not
// permitted, with what to do about it (the udev rule, who holds it); DeviceError where it does not
// answer as it should. Mounts on one Elliptec bus share its USB port, whatever the order in which
// they are opened. `commands` are for instruments of "usbtmc"; others have none. To be called from
// one thread.
std::shared_ptr<Spectrometer> open_spectrometer(const std::string& uri,
                                                const ScpiCommands& commands = {});
std::shared_ptr<Rotator> open_rotator(const std::string& uri);
std::shared_ptr<PsiDeltaHead> open_head(const std::string& uri, const ScpiCommands& commands = {});

}  // namespace drude
