// Finds and loads drude-mpi.so where an MPI launcher started this process: linking MPI would cost
// every start of the program.
#include <cstdlib>
#include <memory>
#include <optional>

#include "base/error.h"
#include "base/module.h"
#include "base/numbers.h"
#include "render/film_ranks.h"
#include "render/mpi/mpi_module.h"

namespace drude {

namespace {

constexpr const char* file_name = "drude-mpi.so";

struct Module {
    decltype(&drude_mpi_start) start = nullptr;
    decltype(&drude_mpi_any) any = nullptr;
    decltype(&drude_mpi_send) send = nullptr;
    decltype(&drude_mpi_receive) receive = nullptr;
    decltype(&drude_mpi_finish) finish = nullptr;
};

Module load(int processes) {
    // Visible: what OpenMPI itself loads looks for its symbols there.
    const LoadedModule loaded = load_module(file_name, true, "OpenMPI (Debian: libopenmpi3)");
    if (!loaded.library) {
        outside_error(
            "an MPI launcher started {} processes, but {} is missing, through which they render "
            "together: looked in {}; install OpenMPI (Debian: libopenmpi-dev) and build again, set "
            "DRUDE_MODULE_PATH to the module's folder, or start one process (or shards, --shard "
            "i/n)",
            processes, file_name, module_folders(file_name));
    }
    Module module;
    decltype(&drude_mpi_version) version = nullptr;
    if (!loaded.resolve("drude_mpi_version", version) || version() != drude_mpi_interface ||
        !loaded.resolve("drude_mpi_start", module.start) ||
        !loaded.resolve("drude_mpi_any", module.any) ||
        !loaded.resolve("drude_mpi_send", module.send) ||
        !loaded.resolve("drude_mpi_receive", module.receive) ||
        !loaded.resolve("drude_mpi_finish", module.finish)) {
        loaded.refuse();
    }
    return module;
}

// How many processes a launcher says that it started; 1 where there is no launcher.
int launched_processes() {
    // Open MPI's mpirun; MPICH's and Intel's; Slurm's srun, which sets its count for every job,
    // with MPI or without, so that it counts only beside PMIx.
    const auto number = [](const char* name) -> std::optional<uint64_t> {
        const char* text = std::getenv(name);
        return text ? parse_unsigned(text) : std::nullopt;
    };
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
        if (const auto value = number(name)) return static_cast<int>(*value);
    }
    if (!std::getenv("PMIX_RANK")) return 1;
    return static_cast<int>(number("SLURM_STEP_NUM_TASKS").value_or(1));
}

class MpiRanks final : public Ranks {
  public:
    explicit MpiRanks(int launched) : module_(load(launched)) {
        char message[256] = "";
        if (module_.start(&rank_, &size_, message, sizeof message) != 0) {
            outside_error("MPI does not start: {}", message);
        }
        if (size_ != launched) {
            outside_error(
                "{} processes were started, but MPI joins {}: the launcher is another MPI's than "
                "the one that {} was built with (OpenMPI); use its mpirun",
                launched, size_, file_name);
        }
    }

    int rank() const override { return rank_; }
    int size() const override { return size_; }
    bool any(bool mine) const override { return module_.any(mine ? 1 : 0) != 0; }
    void send(const void* bytes, size_t count) const override { module_.send(bytes, count); }
    void receive(int from, void* bytes, size_t count) const override {
        module_.receive(from, bytes, count);
    }
    void finish() const override { module_.finish(); }

  private:
    Module module_;
    int rank_ = 0, size_ = 1;
};

}  // namespace

std::unique_ptr<const Ranks> mpi_ranks() {
    const int processes = launched_processes();
    if (processes < 2) return nullptr;
    return std::make_unique<const MpiRanks>(processes);
}

}  // namespace drude
