#pragma once
/** @file
Values on their way from one process to another of the same build: bytes in the machine's own order.

A structure crosses by one function beside it, which serves both directions:

    template <class Values>
    void CrossMembers(Values& values, TableTrial& trial) { Cross(values, trial.name, trial.rows); }

Numbers, truth values, enumerators (with kNumValues), texts, paths, lists, maps, pairs, optional
values and matrices of fixed size need none. */

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/error.h"

namespace graspbench {

/** An enumeration has the values 0 to kNumValues - 1. */
template <class Enum>
inline constexpr int kNumValues = 0;

/** Values that leave: gathered, and handed on in pieces of a megabyte where there is somebody who
takes them. */
class OutgoingValues {
 public:
  static constexpr bool kIsIncoming = false;
  using Take = std::function<void(std::string_view)>;

  explicit OutgoingValues(Take take = nullptr) : take_(std::move(take)) {}

  void Bytes(const void* data, size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
    if (take_ && bytes_.size() >= kPiece) Flush();
  }
  void Flush() {
    take_(bytes_);
    bytes_.clear();
  }
  const std::string& bytes() const { return bytes_; }

 private:
  static constexpr size_t kPiece = size_t{1} << 20;
  Take take_;
  std::string bytes_;
};

/** Values that arrive. They may be anybody's: what does not fit is an Error(kFormat). */
class IncomingValues {
 public:
  static constexpr bool kIsIncoming = true;
  /** Puts the next bytes in their place. */
  using Give = std::function<void(void* data, size_t size)>;

  IncomingValues(size_t size, Give give) : num_left_(size), give_(std::move(give)) {}
  /** @param bytes  outlive this. */
  explicit IncomingValues(std::string_view bytes)
      : IncomingValues(bytes.size(), [next = bytes.data()](void* data, size_t size) mutable {
          std::memcpy(data, next, size);
          next += size;
        }) {}

  void Bytes(void* data, size_t size) {
    Check(size <= num_left_);
    if (size > 0) give_(data, size);
    num_left_ -= size;
  }
  /** A count of values of `size` bytes or more. */
  size_t Count(size_t size) {
    size_t count = 0;
    Bytes(&count, sizeof count);
    Check(count <= num_left_ / size);
    return count;
  }
  void Check(bool is_right) const {
    if (!is_right) throw Error(ErrorKind::kFormat, "an answer that is none");
  }

 private:
  size_t num_left_;
  Give give_;
};

template <class Values, class... Items>
void Cross(Values& values, Items&... items);

namespace internal {

template <class T>
struct IsNumber : std::is_arithmetic<T> {};
template <>
struct IsNumber<bool> : std::false_type {};
template <class T, int kRows, int kCols>
struct IsNumber<Eigen::Matrix<T, kRows, kCols>> : std::bool_constant<(kRows > 0 && kCols > 0)> {
};  // not those whose size is not fixed

/** The place of a list's or a map's item, of the right number. */
template <class Values, class List>
void CrossCount(Values& values, size_t item_size, List& list, size_t& count) {
  if constexpr (Values::kIsIncoming) {
    count = values.Count(item_size);
  } else {
    count = list.size();
    values.Bytes(&count, sizeof count);
  }
}

template <class Values>
void CrossItem(Values& values, bool& item) {
  char byte = item ? 1 : 0;
  values.Bytes(&byte, 1);
  item = byte != 0;
}

template <class Values>
void CrossItem(Values& values, std::string& item) {
  size_t size = 0;
  CrossCount(values, 1, item, size);
  if constexpr (Values::kIsIncoming) item.resize(size);
  values.Bytes(item.data(), size);
}

template <class Values>
void CrossItem(Values& values, std::filesystem::path& path) {
  std::string text = path.string();
  CrossItem(values, text);
  path = text;
}

template <class Values, class T>
void CrossItem(Values& values, std::vector<T>& list) {
  size_t count = 0;
  constexpr bool kIsFlat = IsNumber<T>::value || std::is_enum_v<T>;
  CrossCount(values, kIsFlat ? sizeof(T) : 1, list, count);
  if constexpr (Values::kIsIncoming) list.resize(count);
  if constexpr (kIsFlat) {
    values.Bytes(list.data(), count * sizeof(T));
    if constexpr (Values::kIsIncoming && std::is_enum_v<T>) {
      for (const T item : list) {
        values.Check(static_cast<int>(item) >= 0 && static_cast<int>(item) < kNumValues<T>);
      }
    }
  } else {
    for (T& item : list) Cross(values, item);
  }
}

template <class Values, class First, class Second>
void CrossItem(Values& values, std::pair<First, Second>& pair) {
  Cross(values, pair.first, pair.second);
}

template <class Values, class Value>
void CrossItem(Values& values, std::map<std::string, Value>& map) {
  std::vector<std::pair<std::string, Value>> items(map.begin(), map.end());
  Cross(values, items);
  if constexpr (Values::kIsIncoming) {
    for (auto& item : items) map.insert(std::move(item));
  }
}

template <class Values, class T>
void CrossItem(Values& values, std::optional<T>& item) {
  bool has_value = item.has_value();
  CrossItem(values, has_value);
  if (!has_value) return item.reset();
  if constexpr (Values::kIsIncoming) item.emplace();
  Cross(values, *item);
}

template <class Values>
void CrossItem(Values& values, Eigen::Isometry3d& pose) {
  values.Bytes(pose.data(), sizeof(double) * 16);
}

template <class Values, class T>
auto CrossItem(Values& values, T& item) -> std::enable_if_t<IsNumber<T>::value> {
  values.Bytes(&item, sizeof item);
}

template <class Values, class T>
auto CrossItem(Values& values, T& item) -> std::enable_if_t<std::is_enum_v<T>> {
  auto number = static_cast<int>(item);
  values.Bytes(&number, sizeof number);
  if constexpr (Values::kIsIncoming) values.Check(number >= 0 && number < kNumValues<T>);
  item = static_cast<T>(number);
}

template <class Values, class T>
auto CrossItem(Values& values, T& item) -> decltype(CrossMembers(values, item)) {
  CrossMembers(values, item);
}

}  // namespace internal

template <class Values, class... Items>
void Cross(Values& values, Items&... items) {
  (internal::CrossItem(values, items), ...);
}

template <>
inline constexpr int kNumValues<ErrorKind> = static_cast<int>(ErrorKind::kInterrupted) + 1;
template <>
inline constexpr int kNumValues<Severity> = 2;

template <class Values>
void CrossMembers(Values& values, Diagnostic& entry) {
  Cross(values, entry.severity, entry.file, entry.line, entry.text);
}

/** Those that arrive are added. */
template <class Values>
void CrossMembers(Values& values, Diagnostics& problems) {
  std::vector<Diagnostic> entries = problems.entries();
  Cross(values, entries);
  if constexpr (Values::kIsIncoming) {
    for (const Diagnostic& entry : entries) {
      entry.severity == Severity::kError ? problems.Fail(entry.file, entry.line, entry.text)
                                         : problems.Warn(entry.file, entry.line, entry.text);
    }
  }
}

}  // namespace graspbench
