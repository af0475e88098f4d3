// What every fuzz target does: a reader either reads a text or refuses it as the user's error.
//
// libFuzzer calls LLVMFuzzerTestOneInput with bytes of its own making; anything but a return or an
// Error that tells the user what to change (a crash, another exception, an error of ours or of the
// outside) is a finding. Whatever was read is then used, since a value out of range does its damage
// there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.h"

namespace drude {

template <class Read>
int fuzz_one(const uint8_t* data, size_t size, const Read& read) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    try {
        read(text);
    } catch (const Error& error) {
        if (error.cause() != Cause::user || error.message().empty()) std::abort();
    }
    return 0;
}

}  // namespace drude
