// Files and folders that are removed unless they are finished. The process has one list of them, so that whoever ends
// it early leaves nothing behind, whatever its threads are doing.
//
//   Unfinished file(temporary_path);  // removed at the end of its life, or by remove_unfinished()
//   write(file.path());
//   file.finish([&] { std::filesystem::rename(file.path(), path); });
#pragma once

#include <list>
#include <string>

namespace itin {

class Unfinished {
 public:
  enum class Kind {
    file,            ///< the file, and the journal that SQLite may have beside it
    folder,          ///< the folder, with all that is in it
    folder_if_empty  ///< the folder, only when nothing is in it by then
  };

  /// Nothing need exist under that name yet, but what comes to exist there must be this process's own.
  explicit Unfinished(std::string path, Kind kind = Kind::file);
  /// Removes the file or folder, unless it is finished.
  ~Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  const std::string& path() const { return path_; }

  /// Calls put_in_place(), after which nothing is removed, unless the call throws. It must be brief, as no other file
  /// of the process begins or finishes meanwhile.
  template <class PutInPlace>
  void finish(const PutInPlace& put_in_place) {
    const Lock lock;
    put_in_place();
    keep();
  }

 private:
  friend void remove_unfinished();

  /// Keeps other threads from beginning, finishing or removing anything while it lives.
  struct Lock {
    Lock();
    ~Lock();
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;
  };

  void keep();
  void remove() const;

  std::string path_;
  Kind kind_;
  bool finished_ = false;
  std::list<const Unfinished*>::iterator place_;
};

/// Removes everything that is unfinished, the latest first. A thread that begins or finishes something afterwards waits
/// for ever: the caller must end the process, without destructors.
void remove_unfinished();

}  // namespace itin
