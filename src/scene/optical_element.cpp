// Optical elements in a scene, this renderer's own materials: light goes straight through and
// changes its polarisation alone.
//
//   "linearpolariser"    "float axis" (degrees), "float transmittance"
//   "retarder"           "float axis" of the fast axis, "float retardance" (degrees, 90 is a
//                        quarter-wave plate), "float transmittance"
//   "circularpolariser"  "bool righthanded", "float transmittance"
// The axis counts from the object's x axis, projected perpendicular to the ray, counter-clockwise
// seen looking towards the source from the element's front, where its normal points to.
// The transmittance is that of the light that the ideal element would pass.
#include "scene/builders.h"

namespace drude {

OpticalElementMaterial build_optical_element(const std::string& name, ParameterList& list) {
    using Kind = OpticalElementMaterial::Kind;
    OpticalElementMaterial element;
    element.kind = name == "retarder"            ? Kind::retarder
                   : name == "circularpolariser" ? Kind::circular_polariser
                                                 : Kind::linear_polariser;
    if (element.kind == Kind::circular_polariser) {
        element.right_handed = list.boolean("righthanded", true);
    } else {
        element.axis_deg = list.number_in("axis", 0, -1e6, 1e6);
    }
    if (element.kind == Kind::retarder) {
        element.retardance_deg = list.number_in("retardance", 90, -1e6, 1e6);
    }
    element.transmittance = list.number_in("transmittance", 1, 0, 1);
    return element;
}

}  // namespace drude
