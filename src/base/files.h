// Files: read whole, written whole or not at all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace drude {

// The file's bytes, decompressed where it is gzip (by content, not by name). Throws Error (user)
// where the file is missing, a directory, unreadable, cut short while compressed or larger than
// `limit_bytes` once unpacked; Error (outside) where the disk fails.
std::string read_file(const std::string& path, uint64_t limit_bytes = uint64_t{1} << 31);

// A file that appears under its name only when it is complete: everything is written beside it
// under a temporary name, synced, then renamed over the target. Leaving the scope without commit()
// removes the temporary file and leaves an older target as it was. A link keeps pointing where it
// did and a target keeps its permissions. A target that is no ordinary file (/dev/null, a pipe) is
// not renamed over: commit() copies what was written to it.
class AtomicFile {
  public:
    // Creates the temporary file. Throws Error (user) where `path` is a folder or names one that
    // does not exist, Error (outside) where the folder or an older target may not be written.
    explicit AtomicFile(std::string path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    // Appends; throws Error (outside) where the disk says no.
    void write(std::string_view bytes);

    // For libraries that write by name: they may truncate and fill this file, but not replace it.
    // It has the target's extension.
    const std::string& temporary_path() const { return temporary_path_; }

    // Syncs, renames over the target and syncs the folder; throws Error (outside) on failure.
    void commit();

  private:
    std::string path_;
    std::string final_path_;  // with links followed
    std::string temporary_path_;
    int descriptor_ = -1;
    bool to_device_ = false;
    bool committed_ = false;
};

// Removes the temporary files that AtomicFile left beside `path` in processes of this machine that
// were killed.
void remove_abandoned_files(const std::string& path);

// AtomicFile in one call.
void write_file(const std::string& path, std::string_view bytes);

// For files that are appended to, by descriptor: writes all of `bytes`, signals between or not;
// false with errno set where the system says no.
bool write_all(int descriptor, std::string_view bytes);

// Brings the name of a file that was created or renamed to the disk: syncs the folder it stands in.
// A file system that cannot sync a folder (EINVAL) has nothing more to offer.
void sync_folder_of(const std::string& path);

// Creates the folder and its parents where missing. Throws Error (user) where the name is a file's,
// Error (outside) where the system says no.
void make_folder(const std::string& path);

}  // namespace drude
