// Answers that take long to find, kept for the next time that the same is asked.
//
//   static Remembered<bool> known;
//   if (known.of(code, [&] { return look_up(code); })) ...
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace itin {

/// Keeps a few answers by their questions. Any thread may ask; two that ask the same at once both look it up.
template <class Answer>
class Remembered {
 public:
  /// Returns the answer to the question, which find() gives where it is not known yet.
  template <class Find>
  Answer of(const std::string& question, const Find& find) {
    {
      const std::scoped_lock lock(mutex_);
      if (const auto known = answers_.find(question); known != answers_.end()) return known->second;
    }
    Answer answer = find();
    const std::scoped_lock lock(mutex_);
    if (answers_.size() >= kMost) answers_.clear();
    answers_.insert_or_assign(question, answer);
    return answer;
  }

 private:
  static constexpr std::size_t kMost = 256;

  std::mutex mutex_;
  std::map<std::string, Answer> answers_;
};

}  // namespace itin
