#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/crc32.h"
#include "base/error.h"
#include "base/files.h"
#include "device/bench_clock.h"
#include "device/sweep/journal.h"
#include "device/sweep/journal_bytes.h"
#include "device/sweep/journal_header.h"

namespace drude {

namespace {

constexpr double sync_period_s = 2;

[[noreturn]] void cannot_write(const std::string& path) {
    outside_error("{}: cannot write the journal: {}", path, std::strerror(errno));
}

// Two programs that append to one journal would make it unreadable.
void lock(int descriptor, const std::string& path) {
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return;
    const bool held = errno == EWOULDBLOCK;
    close(descriptor);
    if (held) {
        user_error(
            "{}: another process writes this journal; wait for it, or name another journal "
            "with --journal",
            path);
    }
    cannot_write(path);
}

uint32_t bytes_of_a_count(const JournalHeader& header) {
    return header.spectrometer.max_counts <= 0xFFFF ? 2 : 4;
}

void put_frames(const std::vector<Frame>& frames, uint32_t count_bytes, ByteWriter* out) {
    const size_t pixels = frames.empty() ? 0 : frames.front().counts.size();
    out->reserve(128 + frames.size() * (16 + pixels * count_bytes));
    out->u32(static_cast<uint32_t>(frames.size()));
    out->u32(static_cast<uint32_t>(pixels));
    out->u32(count_bytes);
    for (const Frame& frame : frames) {
        out->f64(frame.requested_s);
        out->f64(frame.arrived_s);
        for (const uint32_t count : frame.counts) out->count(count, count_bytes);
    }
}

}  // namespace

JournalWriter::JournalWriter(std::string path, int descriptor, uint32_t sequence,
                             uint32_t count_bytes)
    : path_(std::move(path)),
      descriptor_(descriptor),
      sequence_(sequence),
      count_bytes_(count_bytes),
      synced_s_(real_clock().now()) {}

JournalWriter::JournalWriter(JournalWriter&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(other.descriptor_),
      sequence_(other.sequence_),
      count_bytes_(other.count_bytes_),
      synced_s_(other.synced_s_) {
    other.descriptor_ = -1;
}

JournalWriter::~JournalWriter() {
    if (descriptor_ < 0) return;
    fdatasync(descriptor_);
    close(descriptor_);
}

JournalWriter JournalWriter::create(const std::string& path, const JournalHeader& header) {
    const int descriptor =
        open(path.c_str(), O_CREAT | O_EXCL | O_RDWR | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno == EEXIST) {
        user_error(
            "{}: is there already and is never overwritten; --resume goes on with it, --journal "
            "names another one",
            path);
    }
    if (descriptor < 0 && (errno == ENOENT || errno == ENOTDIR)) {
        user_error("{}: cannot write the journal: there is no such folder; make it first", path);
    }
    if (descriptor < 0) cannot_write(path);
    lock(descriptor, path);
    JournalWriter writer(path, descriptor, 0, bytes_of_a_count(header));
    if (!write_all(descriptor, journal_magic)) cannot_write(path);
    writer.record(static_cast<uint32_t>(RecordType::header), format_journal_header(header));
    writer.sync();
    sync_folder_of(path);
    return writer;
}

JournalWriter JournalWriter::append(const std::string& path, const Journal& journal) {
    const int descriptor = open(path.c_str(), O_RDWR | O_APPEND | O_CLOEXEC);
    if (descriptor < 0) cannot_write(path);
    lock(descriptor, path);
    JournalWriter writer(path, descriptor, journal.next_sequence,
                         bytes_of_a_count(journal.header.value()));
    struct stat status {};
    if (fstat(descriptor, &status) != 0) cannot_write(path);
    if (static_cast<uint64_t>(status.st_size) != journal.valid_bytes + journal.torn_bytes) {
        user_error("{}: has changed since it was read; does another process write it?", path);
    }
    if (ftruncate(descriptor, static_cast<off_t>(journal.valid_bytes)) != 0) cannot_write(path);
    return writer;
}

void JournalWriter::record(uint32_t type, std::string_view payload) {
    ByteWriter head;
    head.u32(type);
    head.u32(sequence_++);
    head.u32(static_cast<uint32_t>(payload.size()));
    head.u32(crc32(head.bytes()));
    ByteWriter tail;
    tail.u32(crc32(payload));
    // In one call, so that a signal between two leaves no half of a record.
    std::string bytes;
    bytes.reserve(head.bytes().size() + payload.size() + tail.bytes().size());
    bytes.append(head.bytes()).append(payload).append(tail.bytes());
    if (!write_all(descriptor_, bytes)) cannot_write(path_);
    if (real_clock().now() - synced_s_ >= sync_period_s) sync();
}

void JournalWriter::sync() {
    if (fdatasync(descriptor_) != 0 && errno != EINVAL) cannot_write(path_);
    synced_s_ = real_clock().now();
}

void JournalWriter::write(const JournalExposure& exposure) {
    ByteWriter out;
    out.u32(exposure.group);
    out.f64(exposure.integration_s);
    out.f64(exposure.peak);
    record(static_cast<uint32_t>(RecordType::exposure), out.bytes());
}

void JournalWriter::write(const JournalDark& dark) {
    ByteWriter out;
    out.u32(dark.block);
    out.u32(dark.session);
    out.f64(dark.integration_s);
    put_frames(dark.frames, count_bytes_, &out);
    record(static_cast<uint32_t>(RecordType::dark), out.bytes());
}

void JournalWriter::write(const JournalPoint& point) {
    ByteWriter out;
    out.u32(point.index);
    out.u32(point.session);
    out.u32(point.retries);
    for (const double value :
         {point.polariser_deg, point.polariser_reported_deg, point.analyser_deg,
          point.analyser_reported_deg, point.integration_s, point.settled_s}) {
        out.f64(value);
    }
    put_frames(point.frames, count_bytes_, &out);
    record(static_cast<uint32_t>(RecordType::point), out.bytes());
}

void JournalWriter::write(const JournalRows& rows) {
    ByteWriter out;
    out.u32(rows.angle);
    out.u32(static_cast<uint32_t>(rows.rows.size()));
    for (const MeasurementRow& row : rows.rows) {
        for (const double value : {row.wavelength_nm, row.angle_deg, row.psi_deg, row.delta_deg,
                                   row.sigma_psi_deg, row.sigma_delta_deg, row.depolarization}) {
            out.f64(value);
        }
    }
    record(static_cast<uint32_t>(RecordType::rows), out.bytes());
}

void JournalWriter::write(const JournalEvent& event) {
    ByteWriter out;
    out.text(event.kind);
    out.text(event.text);
    record(static_cast<uint32_t>(RecordType::event), out.bytes());
}

void JournalWriter::write(const JournalResume& resume) {
    ByteWriter out;
    out.u32(resume.session);
    out.f64(resume.scale);
    out.f64(resume.scale_sigma);
    out.f64(resume.dark_change_counts);
    record(static_cast<uint32_t>(RecordType::resume), out.bytes());
}

void JournalWriter::write_times(const SweepTimes& times) {
    ByteWriter out;
    for (const double value : {times.total, times.integration, times.discarded, times.motion}) {
        out.f64(value);
    }
    record(static_cast<uint32_t>(RecordType::times), out.bytes());
}

void JournalWriter::write_end() {
    record(static_cast<uint32_t>(RecordType::end), {});
    sync();
}

}  // namespace drude
