// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AtomicFile.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <system_error>

namespace trivariate
{
namespace
{
namespace fs = std::filesystem;

[[noreturn]] void Fail(int error, const std::string& sentence)
{
  throw std::system_error(error, std::generic_category(), sentence);
}

//------------------------------------------------------------------------------
// The file that shall be replaced: behind symbolic links, and one that may be written.
fs::path Target(const std::string& path)
{
  fs::path target = path;
  std::error_code none;
  if (fs::is_symlink(target, none))
  {
    target = fs::weakly_canonical(target, none);
  }
  if (fs::exists(target, none))
  {
    if (!fs::is_regular_file(target, none))
    {
      Fail(fs::is_directory(target, none) ? EISDIR : EINVAL, "The target is not a regular file");
    }
    if (access(target.c_str(), W_OK) != 0)
    {
      Fail(errno, "The existing file may not be overwritten");
    }
  }
  return target;
}

//------------------------------------------------------------------------------
// A file beside the target that vanishes with this object unless it was moved there.
class TemporaryFile
{
public:
  explicit TemporaryFile(const fs::path& target)
    : Folder(target.has_parent_path() ? target.parent_path() : ".")
  {
    static std::atomic<unsigned> count{ 0 };
    const std::string name = target.filename().string() + "." + std::to_string(getpid()) + "-" +
                             std::to_string(count++) + ".part";
    this->Name = this->Folder / name;
#ifdef O_TMPFILE
    this->File = open(this->Folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    this->Nameless = this->File >= 0;
#endif
    if (!this->Nameless)
    {
      this->File = open(this->Name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    }
    if (this->File < 0)
    {
      Fail(errno, "No file can be made in the folder " + this->Folder.string());
    }
  }

  ~TemporaryFile()
  {
    if (!this->Nameless)
    {
      unlink(this->Name.c_str());
    }
    if (this->File >= 0)
    {
      close(this->File);
    }
  }

  TemporaryFile(const TemporaryFile&) = delete;
  void operator=(const TemporaryFile&) = delete;

  void Write(const char* bytes, std::size_t size)
  {
    while (size > 0)
    {
      const ssize_t written = write(this->File, bytes, size);
      if (written < 0 && errno != EINTR)
      {
        Fail(errno, "The file cannot be written");
      }
      const std::size_t step = written > 0 ? static_cast<std::size_t>(written) : 0;
      bytes += step;
      size -= step;
    }
  }

  void MoveTo(const fs::path& target)
  {
    struct stat old;
    const bool keepMode = stat(target.c_str(), &old) == 0;
    if ((keepMode && fchmod(this->File, old.st_mode & 07777) != 0) || fsync(this->File) != 0)
    {
      Fail(errno, "The file cannot be written");
    }
    if (this->Nameless)
    {
      const std::string self = "/proc/self/fd/" + std::to_string(this->File);
      if (linkat(AT_FDCWD, self.c_str(), AT_FDCWD, this->Name.c_str(), AT_SYMLINK_FOLLOW) != 0)
      {
        Fail(errno, "No file can be made in the folder " + this->Folder.string());
      }
      this->Nameless = false;
    }
    const int closed = close(this->File);
    this->File = -1;
    if (closed != 0 || rename(this->Name.c_str(), target.c_str()) != 0)
    {
      Fail(errno, "The file cannot be written");
    }
    this->Nameless = true; // there is no temporary name any more
    // The new name is safe when the folder is on the disk; the file itself is whole either way.
    const int folder = open(this->Folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0)
    {
      fsync(folder);
      close(folder);
    }
  }

private:
  fs::path Folder;
  fs::path Name;
  int File = -1;
  bool Nameless = false; ///< nothing of the name Name has to be removed
};
}

//------------------------------------------------------------------------------
void ReplaceFile(
  const std::string& path, const void* bytes, std::size_t size, const Execution& execution)
{
  const fs::path target = Target(path);
  TemporaryFile file(target);
  constexpr std::size_t Step = std::size_t(1) << 22;
  for (std::size_t begin = 0; begin < size; begin += Step)
  {
    execution.Check(static_cast<double>(begin) / static_cast<double>(size));
    file.Write(static_cast<const char*>(bytes) + begin, std::min(Step, size - begin));
  }
  execution.Check(1.0);
  file.MoveTo(target);
}
}
