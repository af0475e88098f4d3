#include "device/device_error.h"

namespace drude {

const char* fault_name(Fault fault) {
    switch (fault) {
        case Fault::timeout:
            return "time-out";
        case Fault::stall:
            return "stall";
        case Fault::short_read:
            return "short read";
        case Fault::overflow:
            return "overflow";
        case Fault::bad_frame:
            return "bad frame";
        case Fault::unplugged:
            return "unplugged";
        case Fault::io:
            return "transfer failed";
        case Fault::refused:
            return "refused";
        case Fault::mechanical:
            return "mechanical";
        case Fault::interrupted:
            return "interrupted";
    }
    return "unknown";
}

}  // namespace drude
