// What a sweep asks of a spectrometer, whatever protocol it speaks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace drude {

struct SpectrometerInfo {
    std::string uri;  // "ooi:USB4C00001", as a bench file would name it
    std::string model, serial;
    std::vector<double> wavelength_nm;     // of every pixel, strictly ascending
    uint32_t max_counts = 65535;           // a pixel that reads this or more is saturated
    double shortest_s = 0, longest_s = 0;  // integration time
    double readout_s = 0;  // longest time between the end of an integration and its last byte here
    // Coefficients c0, c1, ... of the polynomial by which (counts - dark) is divided, its argument
    // being counts - dark; empty where the device holds none that can be used.
    std::vector<double> nonlinearity;
    // Optically dark pixels (numbers of raw pixels that are not part of wavelength_nm's range of
    // use), first and count; count 0: none known.
    int dark_first = 0, dark_count = 0;
    bool has_lamp_control = false;
    std::vector<std::string> warnings;  // e.g. calibration of the device that could not be used
};

// One exposure of all pixels.
struct Frame {
    std::vector<uint32_t> counts;  // as many as SpectrometerInfo::wavelength_nm
    // By the bench's clock: when the request left, and when the last byte was here.
    double requested_s = 0, arrived_s = 0;
};

class Spectrometer {
  public:
    virtual ~Spectrometer() = default;
    virtual const SpectrometerInfo& info() const = 0;
    // Of the frames that start from now on; throws Error (user) outside shortest_s to longest_s.
    virtual void set_integration_time(double seconds) = 0;
    virtual double integration_time() const = 0;
    // Lamp or shutter, where has_lamp_control; otherwise without effect.
    virtual void set_lamp(bool on) = 0;
    // The next frame that the device hands out. In free run that may have begun before the request:
    // acquire_fresh() (fresh_frame.h) is what measurements use. Waits at most integration time +
    // readout + a margin; throws DeviceError. Every byte of a frame that is returned was checked as
    // far as the protocol allows.
    virtual Frame acquire() = 0;
    // After a DeviceError: clears halts, drains, sets the device up as it was. Throws DeviceError
    // (unplugged) where the device is gone.
    virtual void recover() = 0;
    // After it was unplugged: waits up to `seconds` for the same serial number, opens it and sets
    // it up as it was. False where it did not come back.
    virtual bool reconnect(double seconds) = 0;
};

}  // namespace drude
