#include "usb_bench/fault_plan.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "base/counter_random.h"
#include "base/error.h"
#include "base/numbers.h"

namespace drude::usb_bench {

namespace {

struct Word {
    FaultKind kind;
    const char* word;
};

constexpr Word words[] = {
    {FaultKind::stall, "stall"},
    {FaultKind::silence, "time-out"},
    {FaultKind::short_data, "short"},
    {FaultKind::lost_sync, "sync"},
    {FaultKind::checksum, "checksum"},
    {FaultKind::overflow, "overflow"},
    {FaultKind::saturation, "saturation"},
    {FaultKind::stuck, "stuck"},
    {FaultKind::jam, "jam"},
    {FaultKind::busy, "busy"},
    {FaultKind::unplug, "unplug"},
    {FaultKind::replug, "replug"},
    {FaultKind::kill, "kill"},
};

bool can_suffer(const AnswerShape& shape, FaultKind kind) {
    switch (kind) {
        case FaultKind::stall:
        case FaultKind::silence:
        case FaultKind::unplug:
        case FaultKind::replug:
        case FaultKind::kill:
            return true;
        case FaultKind::short_data:
        case FaultKind::overflow:
            return shape.incoming;
        case FaultKind::lost_sync:
            return shape.sync_at >= 0;
        case FaultKind::checksum:
            return shape.checksum_at >= 0;
        case FaultKind::saturation:
            return static_cast<bool>(shape.saturate);
        case FaultKind::stuck:
        case FaultKind::jam:
        case FaultKind::busy:
            return shape.moves;
    }
    return false;
}

}  // namespace

const char* fault_word(FaultKind kind) {
    for (const Word& word : words) {
        if (word.kind == kind) return word.word;
    }
    return "unknown";
}

const std::vector<FaultKind>& all_fault_kinds() {
    static const std::vector<FaultKind> kinds = [] {
        std::vector<FaultKind> all;
        for (const Word& word : words) all.push_back(word.kind);
        return all;
    }();
    return kinds;
}

PlannedFault parse_fault(const std::string& text) {
    const size_t at = text.find('@'), plus = text.find('+', at == std::string::npos ? 0 : at);
    const std::string kind = text.substr(0, at);
    std::vector<std::string> known;
    for (const Word& word : words) known.push_back(word.word);
    const auto found = std::find(known.begin(), known.end(), kind);
    if (found == known.end()) {
        user_error("--fault: found the kind '{}', expected one of: {}{}", kind,
                   fmt::join(known, " "), did_you_mean(kind, known));
    }
    PlannedFault fault;
    fault.kind = words[found - known.begin()].kind;
    const auto index =
        at == std::string::npos
            ? std::nullopt
            : parse_unsigned(text.substr(at + 1, plus == std::string::npos ? plus : plus - at - 1));
    if (!index) user_error("--fault: found '{}', expected KIND@NUMBER or KIND@NUMBER+MS", text);
    fault.index = *index;
    if (plus != std::string::npos) {
        const auto milliseconds = parse_unsigned(text.substr(plus + 1));
        if (!milliseconds || *milliseconds > 100000) {
            user_error("--fault: found '{}', expected 0 to 100000 milliseconds after '+'", text);
        }
        fault.milliseconds = static_cast<int>(*milliseconds);
    }
    return fault;
}

std::vector<PlannedFault> random_faults(uint64_t seed, int count, uint64_t range) {
    std::vector<PlannedFault> faults;
    if (range == 0) return faults;
    const auto low = [](uint64_t x) { return static_cast<uint32_t>(x); };
    const auto high = [](uint64_t x) { return static_cast<uint32_t>(x >> 32); };
    // Not kill: a list of faults is for one run of the client.
    const size_t kinds = all_fault_kinds().size() - 1;
    for (uint32_t i = 0; i < static_cast<uint32_t>(count); ++i) {
        const PhiloxBlock bits = philox({i, 0, 0, 0}, {low(seed), high(seed)});
        faults.push_back({all_fault_kinds()[bits[0] % kinds], bits[1] % range, std::nullopt});
    }
    return faults;
}

std::optional<PlannedFault> FaultPlan::next(const std::string& device, const AnswerShape& shape) {
    const uint64_t index = answers_.size();
    std::vector<std::string> kinds;
    for (const Word& word : words) {
        if (can_suffer(shape, word.kind)) kinds.push_back(word.word);
    }
    answers_.push_back(fmt::format("{}\t{}\t{}\t{}\t{}", index, device,
                                   shape.incoming ? "in" : "out", shape.what,
                                   fmt::join(kinds, " ")));
    for (const PlannedFault& fault : faults_) {
        if (fault.index != index) continue;
        if (!can_suffer(shape, fault.kind)) {
            not_applicable_.push_back(
                fmt::format("{} at {}", fault_word(fault.kind), answers_.back()));
            continue;
        }
        ++applied_;
        if (fault.kind == FaultKind::kill) {
            if (on_kill) on_kill(fault.milliseconds.value_or(0));
            continue;
        }
        return fault;
    }
    return std::nullopt;
}

bool FaultPlan::upcoming(FaultKind kind) const {
    for (const PlannedFault& fault : faults_) {
        if (fault.index == answers_.size() && fault.kind == kind) return true;
    }
    return false;
}

}  // namespace drude::usb_bench
