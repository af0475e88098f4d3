#include "report/study_samples.h"

namespace drude {

const std::vector<StudySample>& study_samples() {
    static const std::vector<StudySample> samples = {
        {"Copper", "copper", "Cu-McPeak", "Cu-Hagemann", Lobe::blinn_phong, 0.12},
        {"Silver", "silver", "Ag-McPeak", "Ag-Ferrera-298K", Lobe::beckmann, 0.15},
        {"Gold", "gold", "Au-McPeak", "Au-Johnson", Lobe::trowbridge_reitz, 0.1},
        {"Aluminium", "aluminium", "Al-McPeak", "Al-Rakic", Lobe::gaussian, 0.18},
        {"Zinc coating", "zinc", "Zn-Werner-DFT", "Zn-Werner", Lobe::trowbridge_reitz, 0.14},
    };
    return samples;
}

Material made_of(const StudySample& sample) {
    Material material = material_from_set(published_set(sample.set));
    material.name = sample.set;
    material.lobe = sample.lobe;
    material.masking = Masking::v_groove;
    material.beta = sample.beta;
    material.check();
    return material;
}

}  // namespace drude
