#include "device/sweep/correct_azimuths.h"

#include <nlohmann/json.hpp>

namespace drude {

void correct_azimuths(const Calibration& calibration, Bench* bench) {
    // axis = direction (reported - zero), and the true azimuth is the axis less the offset.
    const auto correct = [](double offset_deg, Azimuth* azimuth) {
        if (azimuth->rotator) {
            azimuth->zero_deg += azimuth->direction * offset_deg;
        } else {
            azimuth->fixed_deg -= offset_deg;
        }
    };
    correct(calibration.polariser_offset_deg, &bench->polariser);
    correct(calibration.analyser_offset_deg, &bench->analyser);
    const nlohmann::ordered_json offsets = {
        {"polariser_offset_deg", calibration.polariser_offset_deg},
        {"analyser_offset_deg", calibration.analyser_offset_deg}};
    auto description = nlohmann::ordered_json::parse(bench->description, nullptr, false);
    if (!description.is_object()) description = {{"bench", bench->description}};
    description["azimuths_corrected_by"] = offsets;
    bench->description = description.dump();
}

}  // namespace drude
