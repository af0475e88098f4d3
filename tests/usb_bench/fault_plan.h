// What a virtual USB bench is made to suffer, and when.
//
// Every answer of every device gets the next number: a bulk-IN message, the data stage of a control
// read, and each OUT transfer that the host hands over. Packets by which a serial-port chip says
// that it is idle have no number: how many there are is a matter of time. A fault is given as
// KIND@NUMBER, with +MS where the kind takes a time:
//
//     stall@12   replug@40+250   kill@7+3
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace drude::usb_bench {

enum class FaultKind {
    stall,       // the endpoint halts; nothing of the answer is seen
    silence,     // "time-out": the answer never comes, an OUT transfer is never taken
    short_data,  // "short": half of the bytes
    lost_sync,   // "sync": the byte that marks the message is wrong, or missing on a serial line
    checksum,    // one byte changed under a checksum
    overflow,    // a packet longer than the host asked for
    saturation,  // every pixel of this part of a frame reads full scale
    stuck,       // a mount does not move this time
    jam,         // a mount does not move from now on
    busy,        // a mount answers that it is busy before it moves
    unplug,      // the device leaves the bus
    replug,      // it leaves and comes back after MS (300) milliseconds
    kill,        // the client gets SIGKILL, after MS (0) milliseconds
};

const char* fault_word(FaultKind kind);
const std::vector<FaultKind>& all_fault_kinds();

struct PlannedFault {
    FaultKind kind = FaultKind::stall;
    uint64_t index = 0;
    std::optional<int> milliseconds;
};

// Throws Error (user) with the kinds there are and the nearest one.
PlannedFault parse_fault(const std::string& text);
// `count` different faults at numbers in [0, range), a function of the seed.
std::vector<PlannedFault> random_faults(uint64_t seed, int count, uint64_t range);

// What an answer is, as far as faults ask.
struct AnswerShape {
    std::string what;          // "frame, first part"; for listings
    bool incoming = true;      // from the device; false: an OUT transfer
    int sync_at = -1;          // the byte that marks it; -1: none
    bool serial_line = false;  // a lost byte is missing, not wrong
    int checksum_at = -1;      // a byte under a checksum; -1: none
    bool moves = false;        // what a mount answers to a command to go somewhere
    std::function<void(std::string&)> saturate;  // of a frame; works on its bytes
};

class FaultPlan {
  public:
    void add(const PlannedFault& fault) { faults_.push_back(fault); }
    void clear() { faults_.clear(); }

    // Numbers the answer and returns the fault that befalls it. Kinds that the answer cannot suffer
    // are noted and do nothing.
    std::optional<PlannedFault> next(const std::string& device, const AnswerShape& shape);
    // Whether the next answer will suffer this: for what must be known before it is made.
    bool upcoming(FaultKind kind) const;

    uint64_t count() const { return answers_.size(); }
    // Number, device, "in" or "out", what it is, and the faults that it can suffer, separated by
    // tabs; one an answer.
    const std::vector<std::string>& answers() const { return answers_; }
    int applied() const { return applied_; }
    const std::vector<std::string>& not_applicable() const { return not_applicable_; }

    std::function<void(int milliseconds)> on_kill;

  private:
    std::vector<PlannedFault> faults_;
    std::vector<std::string> answers_;
    std::vector<std::string> not_applicable_;
    int applied_ = 0;
};

}  // namespace drude::usb_bench
