#include "render/film_ranks.h"

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.h"
#include "render/film_partial.h"
#include "render/render.h"

namespace drude {

namespace {

// Fixed size, so that one message carries it: what a rank tells of its part besides the sums.
struct PartMessage {
    uint32_t batches, first, last, fewest;
    FilmCounts counts;
};

void send_text(const Ranks& ranks, const std::string& text) {
    const uint64_t length = text.size();
    ranks.send(&length, sizeof length);
    ranks.send(text.data(), text.size());
}

std::string receive_text(const Ranks& ranks, int from) {
    uint64_t length = 0;
    ranks.receive(from, &length, sizeof length);
    std::string text(length, '\0');
    ranks.receive(from, text.data(), text.size());
    return text;
}

// Names and values of the job but the instruction set, and this.
std::pair<std::string, std::string> described(const FilmJob& job) {
    std::string text;
    for (const auto& [name, value] : job.fields()) {
        if (name != "instruction set") text.append(name).append(" ").append(value).append(", ");
    }
    return {text, job.instruction_set};
}

void receive_film(const Ranks& ranks, int from, bool allow_mixed, RenderedFilm* film) {
    FilmPart part = film->part;
    PartMessage message{};
    ranks.receive(from, &message, sizeof message);
    const std::string job = receive_text(ranks, from), isa = receive_text(ranks, from);
    const auto [own_job, own_isa] = described(film->part.job);
    if (job != own_job) {
        user_error(
            "process {} renders another picture ({}) than process 0 ({}); give all of them "
            "one scene, one program and one command line",
            from, job, own_job);
    }
    if (isa != own_isa && !allow_mixed) {
        user_error(
            "process {} renders with the instruction set {}, process 0 with {}, whose bits differ; "
            "pin it with --isa, or accept the mixture with --allow-mixed",
            from, isa, own_isa);
    }
    part.job.instruction_set = isa;
    part.batches = message.batches;
    part.first = message.first;
    part.last = message.last;
    part.fewest = message.fewest;
    part.counts = message.counts;
    const FilmWords format(part);
    FilmLayout one_row = part.job.layout();
    one_row.height = 1;
    FilmSums row(one_row);
    const auto width = static_cast<size_t>(part.job.width);
    std::vector<uint32_t> words(width * format.channels());
    for (size_t first = 0; first < film->sums.layout().pixels(); first += width) {
        ranks.receive(from, words.data(), words.size() * sizeof(uint32_t));
        bool good = format.read_row(words.data(), &row, 0);
        for (size_t x = 0; good && x < width; ++x) good = film->sums.add(first + x, row, x);
        if (!good) outside_error("the sums that process {} sent arrived damaged", from);
    }
    film->part.counts += part.counts;
    // All ran at the same time.
    film->part.counts.seconds -= part.counts.seconds;
    film->part.first = std::min(film->part.first, part.first);
    film->part.last = std::max(film->part.last, part.last);
    film->part.job.instruction_set = joined_instruction_sets(film->part.job.instruction_set, isa);
}

void send_film(const Ranks& ranks, const RenderedFilm& film) {
    const FilmPart& part = film.part;
    const PartMessage message{part.batches, part.first, part.last, part.fewest, part.counts};
    ranks.send(&message, sizeof message);
    const auto [job, isa] = described(part.job);
    send_text(ranks, job);
    send_text(ranks, isa);
    const FilmWords format(part);
    const auto width = static_cast<size_t>(part.job.width);
    std::vector<uint32_t> words(width * format.channels());
    for (size_t first = 0; first < film.sums.layout().pixels(); first += width) {
        format.write_row(film.sums, first, words.data());
        ranks.send(words.data(), words.size() * sizeof(uint32_t));
    }
}

}  // namespace

void gather_films(const Ranks& ranks, bool allow_mixed, RenderedFilm* film) {
    if (ranks.rank() != 0) return send_film(ranks, *film);
    for (int from = 1; from < ranks.size(); ++from) {
        receive_film(ranks, from, allow_mixed, film);
    }
    film->part.fewest = film->sums.fewest_batches();
    summarise(film);
}

}  // namespace drude
