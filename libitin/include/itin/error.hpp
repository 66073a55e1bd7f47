// Errors as types that carry their data. Every message is one line: what, where, what to do.
//
//   try {
//     import_terrain("wales.itin", {.sources = {"wales.tif"}, .resolution = 0}, progress);
//   } catch (const FileError& error) {
//     std::cerr << error.what() << "; try " << error.path() << " elsewhere\n";
//   } catch (const InputError& error) {
//     std::cerr << error.what() << "; see " << error.field() << '\n';
//   }
//
// Input errors end the command line with status 2, all others with status 1.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace itin {

/// The root of every exception this toolkit throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The call or its input is wrong: an option, a value, a geometry.
class InputError : public Error {
 public:
  /// `field` is the field of the request that is wrong or missing; empty where it is none of them, but a file or a
  /// place.
  explicit InputError(const std::string& what, std::string field = {}) : Error(what), field_(std::move(field)) {}
  /// The name of that field, "cell_size", as its struct declares it.
  const std::string& field() const { return field_; }

 private:
  std::string field_;
};

/// A file could not be read, written or understood.
class FileError : public Error {
 public:
  FileError(std::string path, const std::string& what) : Error(path + ": " + what), path_(std::move(path)) {}
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The file is no store at all, or was written by a newer itin.
class StoreFormatError : public FileError {
 public:
  using FileError::FileError;
};

/// A store whose bytes are not what was written. `place` names the table and row, as `itin check` does.
class CorruptStore : public FileError {
 public:
  CorruptStore(std::string path, std::string place, const std::string& what)
      : FileError(std::move(path), place + ": " + what), place_(std::move(place)) {}
  const std::string& place() const { return place_; }

 private:
  std::string place_;
};

/// The user, or a signal, asked to stop.
class Cancelled : public Error {
 public:
  Cancelled() : Error("interrupted") {}
};

}  // namespace itin
