#include "device/instruments/ooi_models.h"

#include <vector>

namespace drude {

namespace {

// A model of 2048 pixels whose 12 bits come in halves.
OoiModel early_model(uint16_t product, const char* name) {
    OoiModel model;
    model.product = product;
    model.name = name;
    model.out = 0x02;
    model.reply = 0x87;
    model.spectrum = 0x82;
    model.pixels = 2048;
    model.split_bytes = true;
    model.max_counts = 4095;
    model.shortest_us = 3000;
    // 16 bits of milliseconds: more would wrap around to a short time.
    model.longest_us = 65535000;
    model.unit_us = 1000;
    model.step_us = 1000;
    model.readout_s = 0.010;
    model.has_status = false;
    return model;
}

OoiModel fpga_model(uint16_t product, const char* name, int pixels, uint32_t max_counts,
                    uint32_t shortest_us, uint32_t longest_us, uint32_t unit_us) {
    OoiModel model;
    model.product = product;
    model.name = name;
    model.pixels = pixels;
    model.max_counts = max_counts;
    model.shortest_us = shortest_us;
    model.longest_us = longest_us;
    model.unit_us = unit_us;
    model.step_us = unit_us;
    // The detectors are read at about 1 MHz; the rest is the bus and the host.
    model.readout_s = 0.002 + 1e-6 * pixels;
    return model;
}

std::vector<OoiModel> make_models() {
    std::vector<OoiModel> models;
    const auto add = [&](OoiModel model, int dark_first, int dark_count) {
        model.dark_first = dark_first;
        model.dark_count = dark_count;
        models.push_back(model);
    };
    add(early_model(0x1002, "USB2000"), 2, 22);
    add(early_model(0x100A, "HR2000"), 2, 22);
    add(early_model(0x1014, "USB650"), 0, 0);

    OoiModel usb2000_plus =
        fpga_model(0x101E, "USB2000+ / Flame-S", 2048, 65535, 1000, 655350000, 1);
    usb2000_plus.step_us = 1000;
    usb2000_plus.saturation = SaturationSlot::at_6;
    add(usb2000_plus, 6, 15);
    OoiModel hr2000_plus = fpga_model(0x1016, "HR2000+", 2048, 16383, 1000, 655350000, 1);
    hr2000_plus.step_us = 1000;
    hr2000_plus.flip = 0x2000;
    add(hr2000_plus, 2, 22);
    OoiModel hr4000 = fpga_model(0x1012, "HR4000", 3840, 16383, 10, 655350000, 1);
    hr4000.first = 0x86;
    hr4000.step_us = 10;
    hr4000.flip = 0x2000;
    add(hr4000, 2, 11);
    OoiModel usb4000 = fpga_model(0x1022, "USB4000 / Flame-T", 3840, 65535, 10, 65535000, 1);
    usb4000.first = 0x86;
    usb4000.step_us = 10;
    usb4000.saturation = SaturationSlot::at_6;
    add(usb4000, 5, 11);
    OoiModel qe65000 = fpga_model(0x1018, "QE65000", 1280, 65535, 8000, 1600000000, 1000);
    qe65000.flip = 0x8000;
    qe65000.pixel_origin = -10;
    add(qe65000, 0, 4);

    OoiModel maya_pro = fpga_model(0x102A, "Maya2000 Pro", 2304, 64000, 7200, 65000000, 1);
    maya_pro.saturation = SaturationSlot::at_2;
    add(maya_pro, 0, 4);
    add(fpga_model(0x102C, "Maya", 2304, 65535, 15000, 1600000000, 1), 0, 8);
    OoiModel maya_lsl = fpga_model(0x1046, "Maya LSL", 2304, 64000, 7200, 65000000, 1);
    maya_lsl.saturation = SaturationSlot::at_2;
    add(maya_lsl, 0, 4);

    OoiModel nirquest = fpga_model(0x1026, "NIRQuest512", 512, 65535, 1000, 1600000000, 1000);
    nirquest.flip = 0x8000;
    nirquest.has_status = false;
    nirquest.saturation = SaturationSlot::at_6_long;
    add(nirquest, 0, 0);
    nirquest.product = 0x1028;
    nirquest.name = "NIRQuest256";
    nirquest.pixels = 256;
    add(nirquest, 0, 0);
    OoiModel jaz = fpga_model(0x2000, "Jaz", 2048, 65535, 1000, 655350000, 1);
    jaz.step_us = 1000;
    jaz.has_sync = false;
    jaz.has_status = false;
    jaz.saturation = SaturationSlot::at_6;
    add(jaz, 2, 22);
    return models;
}

}  // namespace

const OoiModel* find_ooi_model(uint16_t product) {
    static const std::vector<OoiModel> models = make_models();
    for (const OoiModel& model : models) {
        if (model.product == product) return &model;
    }
    return nullptr;
}

}  // namespace drude
