// Every fault at every answer of a short sweep, through the program itself and libusb.
//
//   fault_matrix FOLDER [--bench full|small|head] [--every N] [--sweep-only] [--only FAULT] [--jobs
//   N]
//     [--kills N] [--seed N] [-o TABLE.md]
//
// Each cell is one run of `drude capture` on the virtual bench with one fault. It must end with the
// right measurement, or with status 3 and one line that names the device; then `drude capture
// --resume` on the same devices, with everything plugged in, must give what the uninterrupted run
// gave. Nothing may hang, nothing may be left open. --kills: as many runs that are ended by SIGKILL
// at moments that the seed chooses, then resumed. Exits with 1 where a cell is not as it should be.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "base/counter_random.h"
#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"
#include "usb_bench/capture_runs.h"
#include "usb_bench/fault_plan.h"

namespace drude {

namespace {

struct MatrixOptions {
    std::string folder, table, only;
    uint64_t every = 1, jobs = 2, kills = 0, seed = 1;
    bool sweep_only = false;
    CaptureBench bench = CaptureBench::full;
};

struct Answer {
    std::string device, what;
    std::vector<std::string> kinds;
};

struct Cell {
    std::string kind, fault, device;
    uint64_t index = 0;
    CaptureResult result;
};

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
}

std::vector<Answer> read_answers(const std::string& list) {
    std::vector<Answer> answers;
    for (const std::string& line : split(list, '\n')) {
        const std::vector<std::string> columns = split(line, '\t');
        if (columns.size() != 5) continue;
        answers.push_back({columns[1], columns[3], split(columns[4], ' ')});
    }
    return answers;
}

// What is left of a run is only kept where something is wrong.
void run_cell(const MatrixOptions& options, const CaptureResult& reference, Cell* cell) {
    const std::string folder = fmt::format("{}/{}-{}", options.folder, cell->kind, cell->index);
    cell->result =
        run_capture_cell(DRUDE_BINARY_DIR, folder, {cell->fault, 1, options.bench}, &reference);
    CaptureResult& result = cell->result;
    const bool killed = result.status == 137;
    if (result.status != 0 && result.status != 3 && !(killed && cell->kind == "kill")) {
        result.troubles.push_back(fmt::format("status {}", result.status));
    }
    // By its URI or its serial number.
    const std::string serial = cell->device.substr(cell->device.find(':') + 1);
    if (result.status == 3 && result.error_line.find(serial) == std::string::npos) {
        result.troubles.push_back(
            fmt::format("the error does not name {}: '{}'", cell->device, result.error_line));
    }
    if (result.applied == 0 && cell->kind != "kill") {
        result.troubles.push_back("the fault did not happen");
    }
    if (result.troubles.empty()) {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
        // Frames of hundreds of runs would fill the memory.
        result.journal = {};
    }
}

void run_all(const MatrixOptions& options, const CaptureResult& reference,
             std::vector<Cell>* cells) {
    std::atomic<size_t> next = 0;
    std::mutex printing;
    const auto work = [&] {
        for (size_t i = next++; i < cells->size(); i = next++) {
            Cell& cell = (*cells)[i];
            run_cell(options, reference, &cell);
            const std::lock_guard guard(printing);
            for (const std::string& trouble : cell.result.troubles) {
                fmt::print("{}: {}\n", cell.fault, trouble);
            }
            std::fflush(stdout);
        }
    };
    std::vector<std::jthread> workers;
    for (uint64_t i = 0; i < options.jobs; ++i) workers.emplace_back(work);
}

std::string table_of(const std::vector<Answer>& answers, const std::vector<Cell>& cells,
                     size_t sweep_begin) {
    struct Row {
        int cells = 0, right = 0, retried = 0, stopped = 0, resumed = 0, wrong = 0;
    };
    std::vector<std::string> order;
    std::map<std::string, Row> rows;
    for (const Cell& cell : cells) {
        if (rows.count(cell.kind) == 0) order.push_back(cell.kind);
        Row& row = rows[cell.kind];
        ++row.cells;
        const CaptureResult& result = cell.result;
        if (result.status == 0) ++(result.retries > 0 ? row.retried : row.right);
        if (result.status != 0) ++row.stopped;
        if (result.status != 0 && result.status_of_second == 0) ++row.resumed;
        if (!result.troubles.empty()) ++row.wrong;
    }
    std::string table = fmt::format(
        "{} answers, {} of them of the sweep itself, the others of opening the instruments.\n\n"
        "| fault | cells | right at once | right after retries | clear error | resumed: equal | "
        "wrong |\n|---|---|---|---|---|---|---|\n",
        answers.size(), answers.size() - sweep_begin);
    for (const std::string& kind : order) {
        const Row& row = rows[kind];
        table += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", kind, row.cells, row.right,
                             row.retried, row.stopped, row.resumed, row.wrong);
    }
    return table;
}

MatrixOptions parse(const std::vector<std::string>& words) {
    MatrixOptions options;
    const auto count = [&](size_t i) {
        const auto value = i < words.size() ? parse_unsigned(words[i]) : std::nullopt;
        if (!value) user_error("fault_matrix: {} wants a number", words[i - 1]);
        return *value;
    };
    for (size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "--every") {
            options.every = std::max<uint64_t>(1, count(++i));
        } else if (words[i] == "--jobs") {
            options.jobs = std::clamp<uint64_t>(count(++i), 1, 64);
        } else if (words[i] == "--kills") {
            options.kills = count(++i);
        } else if (words[i] == "--seed") {
            options.seed = count(++i);
        } else if (words[i] == "--bench" && i + 1 < words.size()) {
            const std::vector<std::string> names = {"full", "small", "head"};
            const auto found = std::find(names.begin(), names.end(), words[++i]);
            if (found == names.end()) user_error("fault_matrix: found --bench {}", words[i]);
            options.bench = static_cast<CaptureBench>(found - names.begin());
        } else if (words[i] == "--sweep-only") {
            options.sweep_only = true;
        } else if (words[i] == "--only" && i + 1 < words.size()) {
            options.only = words[++i];
        } else if (words[i] == "-o" && i + 1 < words.size()) {
            options.table = words[++i];
        } else if (options.folder.empty() && words[i].rfind("-", 0) != 0) {
            options.folder = words[i];
        } else {
            user_error("fault_matrix: found '{}'", words[i]);
        }
    }
    if (options.folder.empty()) user_error("fault_matrix: no folder to work in");
    return options;
}

int run(const MatrixOptions& options) {
    const CaptureResult reference = run_capture_cell(
        DRUDE_BINARY_DIR, options.folder + "/reference", {"", 1, options.bench}, nullptr);
    if (!reference.troubles.empty() || reference.status != 0) {
        outside_error("the run without faults failed: {}", fmt::join(reference.troubles, "; "));
    }
    const std::vector<Answer> answers = read_answers(reference.answer_list);
    // The sweep begins where the first mount looks for its mark.
    size_t sweep_begin = 0;
    const std::string first = options.bench == CaptureBench::head ? "SOUR:ANG" : "ho";
    while (sweep_begin < answers.size() &&
           answers[sweep_begin].what.find(first) == std::string::npos) {
        ++sweep_begin;
    }
    std::vector<Cell> cells;
    uint64_t number = options.seed;
    for (const usb_bench::FaultKind kind : usb_bench::all_fault_kinds()) {
        if (kind == usb_bench::FaultKind::kill) continue;
        const std::string word = usb_bench::fault_word(kind);
        if (!options.only.empty() && word != options.only) continue;
        for (uint64_t i = options.sweep_only ? sweep_begin : 0; i < answers.size(); ++i) {
            const std::vector<std::string>& kinds = answers[i].kinds;
            if (std::find(kinds.begin(), kinds.end(), word) == kinds.end()) continue;
            if (number++ % options.every != 0) continue;
            cells.push_back({word, fmt::format("{}@{}", word, i), answers[i].device, i, {}});
        }
    }
    for (uint32_t i = 0; i < options.kills; ++i) {
        const PhiloxBlock bits = philox({i, 1, 0, 0}, {static_cast<uint32_t>(options.seed), 0});
        const uint64_t index = bits[0] % answers.size();
        // Up to a frame later, so that it also falls between answers.
        cells.push_back({"kill", fmt::format("kill@{}+{}", index, bits[1] % 25), "", 1000 + i, {}});
    }
    run_all(options, reference, &cells);
    const auto wrong = std::count_if(
        cells.begin(), cells.end(), [](const Cell& cell) { return !cell.result.troubles.empty(); });
    const std::string table = table_of(answers, cells, sweep_begin);
    fmt::print("{}{} cells, {} wrong\n", table, cells.size(), wrong);
    if (!options.table.empty()) write_file(options.table, table);
    return wrong == 0 ? 0 : 1;
}

}  // namespace

}  // namespace drude

int main(int argc, char** argv) {
    try {
        return drude::run(drude::parse({argv + 1, argv + argc}));
    } catch (const drude::Error& error) {
        fmt::print(stderr, "{}\n", error.message());
        return static_cast<int>(error.cause());
    }
}
