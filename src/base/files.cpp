#include "base/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <system_error>

#include "base/error.h"
#include "base/numbers.h"

namespace drude {

std::string read_file(const std::string& path, uint64_t limit_bytes) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        user_error("{}: cannot open: {}", path, std::strerror(errno));
    }
    if (S_ISDIR(status.st_mode)) user_error("{}: is a folder; expected a file", path);
    // zlib's reader passes plain files through untouched, so one path serves both.
    const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose);
    if (!file) user_error("{}: cannot open: {}", path, std::strerror(errno));
    std::string bytes;
    char buffer[1 << 16];
    for (;;) {
        const int count = gzread(file.get(), buffer, sizeof buffer);
        int code = Z_OK;
        const char* reason = gzerror(file.get(), &code);
        if (code == Z_ERRNO) {
            if (errno == EIO) outside_error("{}: cannot read: {}", path, std::strerror(errno));
            user_error("{}: cannot read: {}", path, std::strerror(errno));
        }
        // Z_BUF_ERROR is a compressed file cut short: zlib hands out what there is as if it were
        // all.
        if (code == Z_BUF_ERROR) user_error("{}: the compressed data ends too early", path);
        if (count < 0) user_error("{}: cannot unpack: {}", path, reason);
        if (count == 0) break;
        bytes.append(buffer, static_cast<size_t>(count));
        if (bytes.size() > limit_bytes) {
            user_error("{}: found more than {} bytes, expected fewer", path, limit_bytes);
        }
    }
    return bytes;
}

namespace {

std::string cannot_write(const std::string& path) {
    return fmt::format("{}: cannot write: {}", path, std::strerror(errno));
}

// A name beside the target that no other run uses at the same time; `attempt` sets it apart from
// what a crashed run with the same process number left behind.
std::string temporary_name(const std::filesystem::path& folder, const std::filesystem::path& target,
                           unsigned attempt) {
    // A file name holds 255 bytes; the target's own may already do.
    const std::string stem = target.stem().string().substr(0, 100);
    const std::string extension = target.extension().string().substr(0, 100);
    return (folder / fmt::format(".{}.{}-{}.tmp{}", stem, getpid(), attempt, extension)).string();
}

// Copies the whole of `from` to the device, pipe or terminal at `path`.
void copy_to_device(int from, const std::string& path) {
    const int device = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (device < 0) throw Error(Cause::outside, cannot_write(path));
    bool good = lseek(from, 0, SEEK_SET) == 0;
    char buffer[1 << 16];
    while (good) {
        const ssize_t count = ::read(from, buffer, sizeof buffer);
        if (count == 0) break;
        good = count > 0 && write_all(device, {buffer, static_cast<size_t>(count)});
    }
    const std::string message = good ? "" : cannot_write(path);
    close(device);
    if (!good) throw Error(Cause::outside, message);
}

}  // namespace

bool write_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR) return false;
        if (count > 0) bytes.remove_prefix(static_cast<size_t>(count));
    }
    return true;
}

void sync_folder_of(const std::string& path) {
    const std::string parent = std::filesystem::path(path).parent_path().string();
    const int folder = open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY);
    if (folder < 0) return;
    fsync(folder);
    close(folder);
}

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)), final_path_(path_) {
    namespace fs = std::filesystem;
    struct stat status {};
    const bool exists = stat(path_.c_str(), &status) == 0;
    // Found now: the rename at the end of the work would be too late.
    if (!exists && errno == ENAMETOOLONG) user_error("{}: the file name is too long", path_);
    if (path_.empty() || path_.back() == '/' || (exists && S_ISDIR(status.st_mode))) {
        user_error("'{}': is a folder; expected a file name to write to", path_);
    }
    std::error_code error;
    if (exists) {
        // Renaming over a link would replace the link, not the file that it names.
        if (fs::is_symlink(path_, error)) final_path_ = fs::canonical(path_, error).string();
        if (error || final_path_.empty()) final_path_ = path_;
        // Renaming would also replace a file whose owner made it read-only.
        if (access(path_.c_str(), W_OK) != 0) throw Error(Cause::outside, cannot_write(path_));
    }
    // Nothing may be renamed over /dev/null or a pipe.
    to_device_ = exists && !S_ISREG(status.st_mode);
    const fs::path target(final_path_);
    const fs::path folder = to_device_ ? fs::temp_directory_path(error) : target.parent_path();
    static std::atomic<unsigned> counter{0};
    do {
        temporary_path_ = temporary_name(folder, target, counter++);
        descriptor_ = open(temporary_path_.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0) {
        if (errno == ENOENT || errno == ENOTDIR) {
            user_error("{}: cannot write: there is no folder '{}'; make it first", path_,
                       folder.empty() ? "." : folder.string());
        }
        throw Error(Cause::outside, cannot_write(path_));
    }
    // A file that only its owner may read stays so.
    if (exists && !to_device_) fchmod(descriptor_, status.st_mode & 07777);
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!committed_) unlink(temporary_path_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
    if (!write_all(descriptor_, bytes)) throw Error(Cause::outside, cannot_write(path_));
}

void AtomicFile::commit() {
    if (to_device_) return copy_to_device(descriptor_, path_);
    if (fsync(descriptor_) != 0 || rename(temporary_path_.c_str(), final_path_.c_str()) != 0) {
        throw Error(Cause::outside, cannot_write(path_));
    }
    committed_ = true;
    sync_folder_of(final_path_);  // the rename itself must reach the disk too
}

namespace {

double seconds(const timespec& time) {
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// When a living process began, in seconds of the system's clock: field 22 of its /proc/PID/stat,
// behind a name that may hold anything, counts from the start of the machine (proc(5)). Nothing
// where that cannot be read.
std::optional<double> began(pid_t process) {
    std::ifstream file(fmt::format("/proc/{}/stat", process));
    std::string line;
    if (!std::getline(file, line)) return {};
    const size_t name_end = line.rfind(')');
    if (name_end == std::string::npos) return {};
    std::istringstream fields(line.substr(name_end + 1));
    std::string field;
    for (int i = 3; i <= 22; ++i) {
        if (!(fields >> field)) return {};
    }
    const std::optional<long long> ticks = parse_integer(field);
    timespec now{}, since_start{};
    if (!ticks || clock_gettime(CLOCK_REALTIME, &now) != 0 ||
        clock_gettime(CLOCK_BOOTTIME, &since_start) != 0) {
        return {};
    }
    return seconds(now) - seconds(since_start) +
           static_cast<double>(*ticks) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

// Whether the process that bore the number when the file was last written has ended: no process
// bears it, or one that is younger than the file.
bool has_ended(pid_t process, const std::string& file) {
    if (kill(process, 0) != 0 && errno == ESRCH) return true;
    struct stat status {};
    const std::optional<double> start = began(process);
    return start && stat(file.c_str(), &status) == 0 && *start > seconds(status.st_mtim) + 0.1;
}

}  // namespace

void remove_abandoned_files(const std::string& path) {
    namespace fs = std::filesystem;
    const fs::path target(path);
    const std::string before = "." + target.stem().string().substr(0, 100) + ".";
    const std::string after = ".tmp" + target.extension().string().substr(0, 100);
    const fs::path folder = target.parent_path().empty() ? "." : target.parent_path();
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        if (name.size() <= before.size() + after.size() || !name.starts_with(before) ||
            !name.ends_with(after)) {
            continue;
        }
        const std::string middle =
            name.substr(before.size(), name.size() - before.size() - after.size());
        const size_t dash = std::min(middle.find('-'), middle.size());
        const auto process = parse_integer(middle.substr(0, dash));
        if (!process || *process < 1 || *process > std::numeric_limits<pid_t>::max() ||
            !parse_unsigned(middle.substr(std::min(dash + 1, middle.size())))) {
            continue;
        }
        const std::string file = it->path().string();
        if (has_ended(static_cast<pid_t>(*process), file)) unlink(file.c_str());
    }
}

void write_file(const std::string& path, std::string_view bytes) {
    AtomicFile file(path);
    file.write(bytes);
    file.commit();
}

void make_folder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        outside_error("{}: cannot create the folder: {}", path,
                      error ? error.message() : std::strerror(errno));
    }
    if (!S_ISDIR(status.st_mode)) user_error("{}: is a file; expected a folder", path);
}

}  // namespace drude
