// An instrument whose own firmware returns Psi and Delta.
#pragma once

#include <string>
#include <vector>

#include "materials/measurement.h"

namespace drude {

class PsiDeltaHead {
  public:
    virtual ~PsiDeltaHead() = default;
    virtual std::string uri() const = 0;
    // "maker, model, serial, firmware", as the instrument identifies itself.
    virtual std::string identity() const = 0;
    // Rows of one angle of incidence, in degrees in (0, 90), at the instrument's own wavelengths,
    // each within the bounds of MeasurementRow. Throws DeviceError.
    virtual std::vector<MeasurementRow> measure(double incidence_deg) = 0;
    virtual void recover() = 0;
    virtual bool reconnect(double seconds) = 0;
};

}  // namespace drude
