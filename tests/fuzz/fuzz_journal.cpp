// Journals, and what is made of those that can be read. A flipped bit is found by its checksum and
// goes no further, so the mutator's bytes are also put into records with the right ones.
#include "base/crc32.h"
#include "device/sweep/journal_bytes.h"
#include "device/sweep/journal_reduction.h"
#include "fuzz.h"

namespace {

// The records of `text` with their numbers and checksums put right, as far as lengths lead.
std::string with_checksums(const std::string& text) {
    using namespace drude;
    std::string fixed(journal_magic);
    uint32_t sequence = 0;
    for (size_t at = journal_magic.size();
         at + record_head_bytes + record_tail_bytes <= text.size();) {
        ByteReader head(std::string_view(text).substr(at, record_head_bytes));
        const uint32_t type = head.u32();
        head.u32();
        const size_t left = text.size() - at - record_head_bytes - record_tail_bytes;
        const uint32_t length = static_cast<uint32_t>(std::min<size_t>(head.u32(), left));
        const std::string_view payload =
            std::string_view(text).substr(at + record_head_bytes, length);
        ByteWriter writer;
        writer.u32(type);
        writer.u32(sequence++);
        writer.u32(length);
        writer.u32(crc32(writer.bytes()));
        ByteWriter tail;
        tail.u32(crc32(payload));
        fixed.append(writer.bytes()).append(payload).append(tail.bytes());
        at += record_head_bytes + length + record_tail_bytes;
    }
    return fixed;
}

void use(const std::string& text) {
    const drude::Journal journal = drude::parse_journal(text, "fuzz");
    // Longer plans than a seed's would be the recipe's fault, not the reader's.
    if (journal.plan.size() < 2000) drude::reduce_journal(journal, {});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const auto allowed = [](const std::string& text) {
        try {
            use(text);
        } catch (const drude::Error& error) {
            // Nothing follows from frames without light, which is no fault of the reader.
            if (error.cause() != drude::Cause::answer_is_no) throw;
        }
    };
    drude::fuzz_one(data, size, allowed);
    return drude::fuzz_one(data, size,
                           [&](const std::string& text) { allowed(with_checksums(text)); });
}
