// Recognition by content, and then whatever reader it chose.
#include "fitter/import.h"
#include "fitter/import_constants.h"
#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    return drude::fuzz_one(data, size, [](const std::string& text) {
        if (const std::string format = drude::recognise_constants(text); !format.empty()) {
            drude::parse_constants_as(text, "fuzz", format);
        } else {
            drude::format_measurement(drude::parse_measurement_as(text, "fuzz", "auto"));
        }
    });
}
