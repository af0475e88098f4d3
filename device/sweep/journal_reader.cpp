#include <algorithm>
#include <cmath>
#include <limits>

#include "base/crc32.h"
#include "base/error.h"
#include "base/files.h"
#include "base/sha256.h"
#include "device/sweep/journal.h"
#include "device/sweep/journal_bytes.h"
#include "device/sweep/journal_header.h"

namespace drude {

namespace {

// Of a record, beyond which its length is not believed: 1000 frames of 64 Ki pixels of 4 bytes.
constexpr uint32_t longest_record = 1U << 28;

class JournalParser {
  public:
    JournalParser(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

    Journal parse() {
        const size_t magic = std::min(bytes_.size(), journal_magic.size());
        if (bytes_.substr(0, magic) != journal_magic.substr(0, magic)) {
            user_error(
                "{}: found no journal of a sweep, expected a file that 'drude capture' wrote",
                file_);
        }
        if (magic == journal_magic.size()) {
            journal_.valid_bytes = at_ = magic;
            while (at_ < bytes_.size() && read_record()) journal_.valid_bytes = at_;
        }
        journal_.torn_bytes = bytes_.size() - journal_.valid_bytes;
        return std::move(journal_);
    }

  private:
    template <class... Args>
    [[noreturn]] void damaged(fmt::format_string<Args...> what, Args&&... args) const {
        user_error("{}: byte {}: {}; the journal is damaged there, restore it from a copy", file_,
                   at_, fmt::format(what, std::forward<Args>(args)...));
    }

    bool zeros_from(size_t offset) const {
        return bytes_.find_first_not_of('\0', std::min(offset, bytes_.size())) ==
               std::string_view::npos;
    }

    // False where the rest is a record that a crash cut short.
    bool read_record() {
        if (bytes_.size() - at_ < record_head_bytes) return false;
        const std::string_view head = bytes_.substr(at_, record_head_bytes);
        ByteReader fields(head);
        const uint32_t type = fields.u32(), sequence = fields.u32(), length = fields.u32();
        if (crc32(head.substr(0, 12)) != fields.u32()) {
            // The file was made longer and the power went before its contents were there.
            if (zeros_from(at_ + record_head_bytes - 4)) return false;
            damaged("found a record whose head does not match its checksum");
        }
        if (sequence != journal_.next_sequence) {
            damaged("found record number {}, expected {}", sequence, journal_.next_sequence);
        }
        if (length > longest_record) damaged("found a record of {} bytes", length);
        const size_t payload_at = at_ + record_head_bytes;
        const size_t end = payload_at + length + record_tail_bytes;
        if (end > bytes_.size()) return false;
        const std::string_view payload = bytes_.substr(payload_at, length);
        if (crc32(payload) != ByteReader(bytes_.substr(payload_at + length, 4)).u32()) {
            if (zeros_from(payload_at + length)) return false;
            damaged("found a record whose contents do not match their checksum");
        }
        if (journal_.complete) damaged("found a record behind the last one");
        if ((sequence == 0) != (type == static_cast<uint32_t>(RecordType::header))) {
            damaged("found a record of type {} as number {}", type, sequence);
        }
        ByteReader reader(payload);
        read_payload(static_cast<RecordType>(type), payload, reader);
        if (type != static_cast<uint32_t>(RecordType::header) &&
            (!reader.good() || reader.left() > 0)) {
            damaged("found a record of type {} with {} bytes, which do not fit its contents", type,
                    length);
        }
        at_ = end;
        ++journal_.next_sequence;
        return true;
    }

    void read_payload(RecordType type, std::string_view payload, ByteReader& in) {
        switch (type) {
            case RecordType::header:
                return read_header(payload);
            case RecordType::exposure:
                return read_exposure(in);
            case RecordType::dark:
                return read_dark(in);
            case RecordType::point:
                return read_point(in);
            case RecordType::rows:
                return read_rows(in);
            case RecordType::event:
                return read_event(in);
            case RecordType::resume:
                return read_resume(in);
            case RecordType::times:
                return read_times(in);
            case RecordType::end:
                journal_.complete = true;
                return;
        }
        damaged("found a record of the unknown type {}", static_cast<uint32_t>(type));
    }

    void read_header(std::string_view payload) {
        journal_.header =
            parse_journal_header(std::string(payload), fmt::format("{}, its header", file_));
        journal_.recipe_sha256 = sha256(format_recipe(journal_.header->recipe));
        journal_.plan = make_plan(journal_.header->recipe);
        blocks_ = journal_.plan.empty() ? 0 : journal_.plan.back().block + 1;
    }

    uint32_t index(ByteReader& in, size_t bound, const char* what) const {
        const uint32_t value = in.u32();
        if (in.good() && value >= bound) damaged("found {} {} of {}", what, value, bound);
        return value;
    }

    double finite(ByteReader& in) const {
        const double value = in.f64();
        if (!std::isfinite(value)) damaged("found a number that is not finite");
        return value;
    }

    double positive(ByteReader& in) const {
        const double value = finite(in);
        if (in.good() && !(value > 0)) damaged("found {}, expected a number above 0", value);
        return value;
    }

    uint32_t session(ByteReader& in) const {
        return index(in, journal_.resumes.size() + 1, "session");
    }

    std::vector<Frame> read_frames(ByteReader& in) const {
        const uint32_t count = in.u32(), pixels = in.u32(), size = in.u32();
        const size_t expected = journal_.header->spectrometer.wavelength_nm.size();
        if (!in.good() || count == 0 || pixels == 0 || pixels != expected ||
            (size != 2 && size != 4)) {
            damaged("found {} frames of {} pixels, expected frames of {}", count, pixels, expected);
        }
        if (uint64_t{count} * (16 + uint64_t{pixels} * size) != in.left()) {
            damaged("found {} bytes for {} frames", in.left(), count);
        }
        std::vector<Frame> frames(count);
        for (Frame& frame : frames) {
            frame.requested_s = finite(in);
            frame.arrived_s = finite(in);
            frame.counts.resize(pixels);
            for (uint32_t& value : frame.counts) value = in.count(size);
        }
        return frames;
    }

    void read_exposure(ByteReader& in) {
        JournalExposure exposure;
        exposure.group = index(in, 2, "exposure group");
        exposure.integration_s = positive(in);
        exposure.peak = finite(in);
        journal_.exposures.push_back(exposure);
    }

    void read_dark(ByteReader& in) {
        JournalDark dark;
        dark.block = index(in, blocks_, "block");
        dark.session = session(in);
        dark.integration_s = positive(in);
        dark.frames = read_frames(in);
        journal_.darks.push_back(std::move(dark));
    }

    void read_point(ByteReader& in) {
        JournalPoint point;
        point.index = index(in, journal_.plan.size(), "point");
        point.session = session(in);
        point.retries = in.u32();
        for (double* value : {&point.polariser_deg, &point.polariser_reported_deg,
                              &point.analyser_deg, &point.analyser_reported_deg}) {
            *value = finite(in);
        }
        point.integration_s = positive(in);
        point.settled_s = finite(in);
        point.frames = read_frames(in);
        measured_.resize(journal_.plan.size());
        if (measured_[point.index]) damaged("found point {} a second time", point.index);
        measured_[point.index] = true;
        journal_.points.push_back(std::move(point));
    }

    void read_rows(ByteReader& in) {
        JournalRows rows;
        rows.angle = index(in, journal_.header->recipe.angles_deg.size(), "angle");
        const uint32_t count = in.u32();
        if (in.left() != uint64_t{count} * 56) {
            damaged("found {} bytes for {} rows", in.left(), count);
        }
        rows.rows.resize(count);
        for (MeasurementRow& row : rows.rows) {
            for (double* value : {&row.wavelength_nm, &row.angle_deg, &row.psi_deg, &row.delta_deg,
                                  &row.sigma_psi_deg, &row.sigma_delta_deg, &row.depolarization}) {
                *value = finite(in);
            }
        }
        for (const JournalRows& before : journal_.rows) {
            if (before.angle == rows.angle) damaged("found angle {} a second time", rows.angle);
        }
        journal_.rows.push_back(std::move(rows));
    }

    void read_event(ByteReader& in) {
        JournalEvent event;
        event.kind = in.text();
        event.text = in.text();
        journal_.events.push_back(std::move(event));
    }

    void read_resume(ByteReader& in) {
        JournalResume resume;
        resume.session = in.u32();
        resume.scale = positive(in);
        resume.scale_sigma = finite(in);
        resume.dark_change_counts = finite(in);
        if (resume.session != journal_.resumes.size() + 1) {
            damaged("found session {}, expected {}", resume.session, journal_.resumes.size() + 1);
        }
        journal_.resumes.push_back(resume);
    }

    void read_times(ByteReader& in) {
        journal_.times.total += finite(in);
        journal_.times.integration += finite(in);
        journal_.times.discarded += finite(in);
        journal_.times.motion += finite(in);
    }

    std::string_view bytes_;
    const std::string& file_;
    size_t at_ = 0;
    size_t blocks_ = 0;
    std::vector<bool> measured_;
    Journal journal_;
};

}  // namespace

const JournalExposure* Journal::exposure(uint32_t group) const {
    for (const JournalExposure& exposure : exposures) {
        if (exposure.group == group) return &exposure;
    }
    return nullptr;
}

const JournalDark* Journal::dark(uint32_t block) const {
    for (const JournalDark& dark : darks) {
        if (dark.block == block) return &dark;
    }
    return nullptr;
}

size_t Journal::retries() const {
    return static_cast<size_t>(
        std::count_if(events.begin(), events.end(),
                      [](const JournalEvent& event) { return event.kind == "retry"; }));
}

Journal parse_journal(std::string_view bytes, const std::string& file) {
    return JournalParser(bytes, file).parse();
}

Journal read_journal(const std::string& path) {
    return parse_journal(read_file(path, uint64_t{1} << 32), path);
}

}  // namespace drude
