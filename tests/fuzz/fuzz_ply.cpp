#include "fuzz.h"
#include "scene/ply.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    return drude::fuzz_one(data, size, [](const std::string& text) {
        drude::Messages messages;
        drude::parse_ply(text, "fuzz.ply", messages);
    });
}
