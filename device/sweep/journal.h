// The journal of a sweep: every raw frame, as it came in, and what happened on the way.
//
// A file of records that only grows. It begins with the 8 bytes "DRUDEJ1\n"; each record is, little
// endian,
//
//     u32 type   u32 sequence number, from 0   u32 length of the payload   u32 CRC of these 12
//     bytes payload    u32 CRC of the payload
//
// so that a record cut short by a crash is told from a byte that changed. What a sweep measured is
// a pure function of these bytes: Psi and Delta can be derived again with another calibration.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "device/spectrometer.h"
#include "device/sweep/plan.h"
#include "device/sweep/recipe.h"
#include "materials/measurement.h"

namespace drude {

struct JournalHeader {
    Recipe recipe;  // adapted to the bench
    std::string bench_name, bench_description;
    bool is_virtual = false;
    std::vector<std::pair<std::string, std::string>> notes;  // of the bench
    std::vector<std::string> warnings;                       // of the bench and its recipe
    bool has_spectrometer = true;                            // false: a head that returns rows
    SpectrometerInfo spectrometer;
    std::string head_identity;
    double mount_repeatability_deg = 0;     // of the polariser's mount
    double analyser_repeatability_deg = 0;  // of the analyser's
    std::string software;                   // "drude 0.1.0"
    std::string started;                    // UTC, ISO 8601; empty for virtual benches
};

struct JournalExposure {
    uint32_t group = 0;
    double integration_s = 0;
    double peak = 0;  // of the brightest pixel at the brightest setting, over max_counts
};

// Session 0 made the journal; every --resume begins another.
struct JournalDark {
    uint32_t block = 0, session = 0;
    double integration_s = 0;
    std::vector<Frame> frames;
};

struct JournalPoint {
    uint32_t index = 0;  // in the plan
    uint32_t session = 0;
    uint32_t retries = 0;
    // Azimuths of the axes and what the mounts reported (0 where nothing turns), in degrees.
    double polariser_deg = 0, polariser_reported_deg = 0;
    double analyser_deg = 0, analyser_reported_deg = 0;
    double integration_s = 0;
    double settled_s = 0;  // by the bench's clock
    std::vector<Frame> frames;
};

// Rows of one angle of incidence, of an instrument that returns Psi and Delta.
struct JournalRows {
    uint32_t angle = 0;  // its number in the recipe
    std::vector<MeasurementRow> rows;
};

// "retry", "warning".
struct JournalEvent {
    std::string kind, text;
};

// What a new session found of an old point: net counts over those of before.
struct JournalResume {
    uint32_t session = 0;
    double scale = 1, scale_sigma = 0;  // sigma 0: there was nothing to compare
    double dark_change_counts = 0;      // mean of the new dark less the old
};

// Seconds by the bench's clock, of all sessions together.
struct SweepTimes {
    double total = 0, integration = 0;
    double discarded = 0;  // integrating frames that were stale
    double motion = 0;
    double elsewhere() const { return total - integration - discarded - motion; }
};

struct Journal {
    std::optional<JournalHeader> header;  // none: nothing was written before the crash
    std::string recipe_sha256;
    std::vector<PlanPoint> plan;  // of the header's recipe
    std::vector<JournalExposure> exposures;
    std::vector<JournalDark> darks;
    std::vector<JournalPoint> points;
    std::vector<JournalRows> rows;
    std::vector<JournalEvent> events;
    std::vector<JournalResume> resumes;
    SweepTimes times;
    bool complete = false;
    uint64_t valid_bytes = 0;  // where the next record belongs
    uint64_t torn_bytes = 0;   // behind it, of a record that a crash cut short
    uint32_t next_sequence = 0;

    const JournalExposure* exposure(uint32_t group) const;  // or null
    const JournalDark* dark(uint32_t block) const;          // the first of it, or null
    size_t retries() const;
};

// `file` names it in errors. A record that ends behind the end of `bytes`, or whose end is zeros up
// to there (as a power cut leaves it), is dropped and counted in torn_bytes. Throws Error (user)
// with the byte for everything else that is wrong: checksums, numbers out of order, contents.
Journal parse_journal(std::string_view bytes, const std::string& file);
Journal read_journal(const std::string& path);

// Appends records; on disk at most two seconds later, and when it is closed.
class JournalWriter {
  public:
    // Throws Error (user) where the file is there already, Error (outside) where the disk says no.
    static JournalWriter create(const std::string& path, const JournalHeader& header);
    // Goes on behind what was read, cutting a torn record off. Throws Error (user) where another
    // process writes it.
    static JournalWriter append(const std::string& path, const Journal& journal);
    ~JournalWriter();
    JournalWriter(JournalWriter&& other) noexcept;
    JournalWriter& operator=(JournalWriter&&) = delete;

    void write(const JournalExposure& exposure);
    void write(const JournalDark& dark);
    void write(const JournalPoint& point);
    void write(const JournalRows& rows);
    void write(const JournalEvent& event);
    void write(const JournalResume& resume);
    void write_times(const SweepTimes& times);  // of this session
    void write_end();
    void sync();

  private:
    JournalWriter(std::string path, int descriptor, uint32_t sequence, uint32_t count_bytes);
    void record(uint32_t type, std::string_view payload);

    std::string path_;
    int descriptor_ = -1;
    uint32_t sequence_ = 0;
    uint32_t count_bytes_ = 2;  // of one count in a frame
    double synced_s_ = 0;
};

}  // namespace drude
