#include "device/instruments/obp_models.h"

#include <vector>

namespace drude {

namespace {

ObpModel first_model(uint16_t product, const char* name, int pixels, uint32_t max_counts,
                     uint32_t shortest_us, uint32_t longest_us) {
    ObpModel model;
    model.vendor = 0x2457;
    model.product = product;
    model.name = name;
    model.spectrum_message = 0x00101100;
    model.pixels = pixels;
    model.max_counts = max_counts;
    model.shortest_us = shortest_us;
    model.longest_us = longest_us;
    // The detectors are read at about 1 MHz; the rest is the bus and the host.
    model.readout_s = 0.003 + 1e-6 * pixels;
    return model;
}

ObpModel second_model(uint16_t product, const char* name, int pixels, uint32_t shortest_us,
                      uint32_t longest_us) {
    ObpModel model = first_model(product, name, pixels, 65535, shortest_us, longest_us);
    model.vendor = 0x0999;
    model.second = true;
    model.spectrum_message = 0x00001C00;
    model.metadata_bytes = 32;
    return model;
}

std::vector<ObpModel> make_models() {
    std::vector<ObpModel> models;
    models.push_back(first_model(0x4000, "STS", 1024, 16383, 10, 85000000));
    models.push_back(first_model(0x4200, "Spark", 1024, 16383, 10, 85000000));
    ObpModel ventana = first_model(0x5000, "Ventana", 1024, 65535, 22000, 60000000);
    ventana.in = 0x82;
    models.push_back(ventana);
    ObpModel hdx = first_model(0x2003, "HDX", 2068, 65535, 6000, 10000000);
    hdx.spectrum_message = 0x00101000;
    models.push_back(hdx);
    // Of its 18 bits: SeaBreeze's maximum of this model, above which the detector is full.
    ObpModel qe_pro = first_model(0x4004, "QE Pro", 1044, 200000, 8000, 1600000000);
    qe_pro.spectrum_message = 0x00100928;
    qe_pro.clear_message = 0x00100830;
    qe_pro.metadata_bytes = 32;
    qe_pro.bytes_per_count = 4;
    qe_pro.dark_count = 4;
    models.push_back(qe_pro);

    ObpModel sr2 = second_model(0x1001, "SR2", 2110, 1, 2000000);
    sr2.dark_count = 24;
    models.push_back(sr2);
    models.push_back(second_model(0x1002, "SR4", 3648, 3800, 10000000));
    models.push_back(second_model(0x1005, "SR6", 2048, 7200, 5000000));
    models.push_back(second_model(0x1003, "HR2", 2110, 1, 2000000));
    models.push_back(second_model(0x1004, "HR4", 3648, 3800, 10000000));
    models.push_back(second_model(0x1006, "HR6", 2048, 7200, 5000000));
    ObpModel st = second_model(0x1000, "ST", 1516, 1560, 6000000);
    st.max_counts = 16383;
    st.unit_us = 10;
    st.dark_first = 1503;
    st.dark_count = 13;
    models.push_back(st);
    return models;
}

}  // namespace

const ObpModel* find_obp_model(uint16_t vendor, uint16_t product) {
    static const std::vector<ObpModel> models = make_models();
    for (const ObpModel& model : models) {
        if (model.vendor == vendor && model.product == product) return &model;
    }
    return nullptr;
}

}  // namespace drude
