#pragma once
/** @file
JSON values: null, booleans, numbers, strings, lists, and objects whose keys keep their order.
Numbers are written in their shortest exact form; a missing number is null, never a plausible
number. Text is parsed and written in json.cc, the only file that includes the JSON library. */

#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <initializer_list>
#include <iosfwd>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/pose.h"

namespace graspbench {

class JsonItem;

/** A JSON value and everything that it contains. Throws Json::exception if an operation does not
suit the value's type, or if an index or a key does not exist. */
class Json {
 public:
  /** Describes the fault of a text or of a value: "[json.exception.type_error.302] type must be
  string, but is number". */
  class exception : public std::exception {
   public:
    explicit exception(std::string text) : text_(std::move(text)) {}
    const char* what() const noexcept override { return text_.c_str(); }

   private:
    std::string text_;
  };
  enum class Type : uint8_t {
    kNull,
    kBoolean,
    kInteger,
    kUnsigned,  ///< type of parsed integers without a sign
    kFloat,
    kString,
    kArray,
    kObject,
    kDiscarded  ///< result of parsing invalid text
  };
  using array_t = std::vector<Json>;
  using object_t = std::vector<std::pair<std::string, Json>>;  ///< each key once
  template <class Value, class Member>
  class Iterator;
  using value_type = Json;
  using iterator = Iterator<Json, std::pair<std::string, Json>>;
  using const_iterator = Iterator<const Json, const std::pair<std::string, Json>>;

  Json() = default;
  Json(std::nullptr_t) {}
  Json(bool value) : type_(Type::kBoolean) { boolean_ = value; }
  Json(int value) : Json(static_cast<long>(value)) {}
  Json(long value) : type_(Type::kInteger) { integer_ = value; }
  Json(long long value) : Json(static_cast<long>(value)) {}
  Json(unsigned value) : Json(static_cast<unsigned long>(value)) {}
  Json(unsigned long value) : type_(Type::kUnsigned) { unsigned_ = value; }
  Json(unsigned long long value) : Json(static_cast<unsigned long>(value)) {}
  Json(double value) : type_(Type::kFloat) { float_ = value; }
  Json(const char* value) : Json(std::string(value)) {}
  Json(std::string_view value) : Json(std::string(value)) {}
  Json(std::string value);
  Json(array_t items);
  Json(object_t members);
  template <class T>
  Json(const T* pointer) = delete;  // would convert to bool
  /** Makes an object if each item is a list of a string (key) and a value; otherwise a list. */
  Json(std::initializer_list<JsonItem> items);
  template <class T>
  Json(const std::vector<T>& items) : Json(array_t(items.begin(), items.end())) {}
  template <class T>
  Json(const std::set<T>& items) : Json(array_t(items.begin(), items.end())) {}
  template <class T, size_t N>
  Json(const std::array<T, N>& items) : Json(array_t(items.begin(), items.end())) {}
  template <class T>
  Json(const std::map<std::string, T>& members) : Json(object_t(members.begin(), members.end())) {}

  Json(const Json& other);
  Json(Json&& other) noexcept : type_(other.type_), integer_(other.integer_) {
    other.type_ = Type::kNull;
  }
  Json& operator=(const Json& other) { return *this = Json(other); }
  Json& operator=(Json&& other) noexcept {
    Json taken(std::move(other));  // first, because this value may contain the other
    std::swap(type_, taken.type_);
    std::swap(integer_, taken.integer_);
    return *this;
  }
  ~Json() {
    if (type_ >= Type::kString) Destroy();
  }

  static Json array() { return array_t(); }
  static Json array(std::initializer_list<JsonItem> items);
  static Json object() { return object_t(); }
  /** Parses a text. @throws exception with line and column. */
  static Json parse(std::string_view text);
  /** Parses a text; returns a discarded value if it is not valid JSON. */
  static Json try_parse(std::string_view text);
  /** Formats the value on one line or indented. Bytes that are not UTF-8 (in file names) become
  U+FFFD. */
  std::string dump(int indent = -1) const;

  Type type() const { return type_; }
  bool is_null() const { return type_ == Type::kNull; }
  bool is_boolean() const { return type_ == Type::kBoolean; }
  bool is_number() const { return is_number_integer() || type_ == Type::kFloat; }
  bool is_number_integer() const { return type_ == Type::kInteger || type_ == Type::kUnsigned; }
  bool is_string() const { return type_ == Type::kString; }
  bool is_array() const { return type_ == Type::kArray; }
  bool is_object() const { return type_ == Type::kObject; }
  bool is_discarded() const { return type_ == Type::kDiscarded; }

  /** Returns the value as a bool, number, string, vector of strings or numbers, or map of
  strings. */
  template <class T>
  T get() const;
  const std::string& str() const;

  /** Returns the number of items or members; 0 for null, 1 for any other value. */
  size_t size() const;
  bool empty() const { return size() == 0; }
  /** Iterate over the items of a list or the values of an object. Any other value is its own single
  item; null has none. */
  const_iterator begin() const;
  const_iterator end() const;
  iterator begin();
  iterator end();
  /** Returns the keys with their values; none for null. */
  const object_t& items() const;
  object_t& items();

  const Json& at(size_t index) const;
  Json& at(size_t index) { return const_cast<Json&>(std::as_const(*this).at(index)); }
  const Json& at(std::string_view key) const;
  Json& at(std::string_view key) { return const_cast<Json&>(std::as_const(*this).at(key)); }
  const Json& operator[](size_t index) const;
  const Json& operator[](std::string_view key) const;
  Json& operator[](size_t index) { return const_cast<Json&>(std::as_const(*this)[index]); }
  /** Adds the key with the value null if it is absent; null becomes an object. */
  Json& operator[](std::string_view key);
  const Json& front() const { return at(0); }
  const Json& back() const { return at(size() - 1); }
  Json& front() { return at(0); }
  Json& back() { return at(size() - 1); }

  /** Returns the key's value; nullptr if the key is absent or this is not an object. */
  const Json* find(std::string_view key) const;
  bool contains(std::string_view key) const { return find(key) != nullptr; }
  /** Returns the key's value, or the fallback if the key is absent. */
  template <class T>
  T value(std::string_view key, const T& fallback) const;
  std::string value(std::string_view key, const char* fallback) const;

  /** Appends an item; null becomes a list. */
  void push_back(Json item);
  /** Sets all members of `other` here; null becomes an object. */
  void update(const Json& other);
  /** Adds the key if it is absent; null becomes an object. */
  void emplace(std::string_view key, Json item);
  void erase(std::string_view key);

  /** Numbers compare by value, objects by keys in the same order. */
  friend bool operator==(const Json& a, const Json& b) { return a.IsEqual(b); }
  friend bool operator!=(const Json& a, const Json& b) { return !a.IsEqual(b); }
  friend std::ostream& operator<<(std::ostream& out, const Json& json);

 private:
  [[noreturn]] void FailType(const char* expected) const;
  [[noreturn]] void FailUse(int code, const char* use) const;
  void Destroy();
  bool IsEqual(const Json& other) const;
  template <class T>
  T GetNumber() const;

  Type type_ = Type::kNull;
  union {
    bool boolean_;
    int64_t integer_ = 0;
    uint64_t unsigned_;
    double float_;
    std::string* string_;
    array_t* array_;
    object_t* object_;
  };
};

/** An item of an initialiser list, to be moved from. */
class JsonItem {
 public:
  JsonItem() = default;
  template <class T, class = std::enable_if_t<std::is_constructible_v<Json, T&&>>>
  JsonItem(T&& item) : value(std::forward<T>(item)) {}
  JsonItem(std::initializer_list<JsonItem> items) : value(items) {}

  mutable Json value;
};

template <class Value, class Member>
class Json::Iterator {
 public:
  using iterator_category = std::forward_iterator_tag;
  using value_type = Json;
  using difference_type = std::ptrdiff_t;
  using pointer = Value*;
  using reference = Value&;

  Iterator() = default;
  explicit Iterator(Value* item) : item_(item) {}
  explicit Iterator(Member* member) : member_(member) {}

  Value& operator*() const { return member_ != nullptr ? member_->second : *item_; }
  Value* operator->() const { return &**this; }
  Iterator& operator++() {
    member_ != nullptr ? static_cast<void>(++member_) : static_cast<void>(++item_);
    return *this;
  }
  Iterator operator++(int) {
    const Iterator before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(Iterator a, Iterator b) {
    return a.item_ == b.item_ && a.member_ == b.member_;
  }
  friend bool operator!=(Iterator a, Iterator b) { return !(a == b); }

 private:
  Value* item_ = nullptr;
  Member* member_ = nullptr;  ///< of an object; otherwise null
};

inline Json::const_iterator Json::begin() const {
  if (is_array()) return const_iterator(array_->data());
  return is_object() ? const_iterator(object_->data()) : const_iterator(this);
}
inline Json::const_iterator Json::end() const {
  if (is_array()) return const_iterator(array_->data() + array_->size());
  return is_object() ? const_iterator(object_->data() + object_->size())
                     : const_iterator(this + (is_null() ? 0 : 1));
}
inline Json::iterator Json::begin() {
  if (is_array()) return iterator(array_->data());
  return is_object() ? iterator(object_->data()) : iterator(this);
}
inline Json::iterator Json::end() {
  if (is_array()) return iterator(array_->data() + array_->size());
  return is_object() ? iterator(object_->data() + object_->size())
                     : iterator(this + (is_null() ? 0 : 1));
}

template <>
bool Json::get<bool>() const;
template <>
int Json::get<int>() const;
template <>
long Json::get<long>() const;
template <>
long long Json::get<long long>() const;
template <>
unsigned long Json::get<unsigned long>() const;
template <>
double Json::get<double>() const;
template <>
std::string Json::get<std::string>() const;
template <>
Json Json::get<Json>() const;
template <>
std::vector<std::string> Json::get<std::vector<std::string>>() const;
template <>
std::vector<double> Json::get<std::vector<double>>() const;
template <>
std::map<std::string, std::string> Json::get<std::map<std::string, std::string>>() const;

template <class T>
T Json::value(std::string_view key, const T& fallback) const {
  if (!is_object()) FailUse(306, "value()");
  const Json* const found = find(key);
  return found != nullptr ? found->get<T>() : fallback;
}

/** Returns a number, or null if it is not finite. */
inline Json JsonNumber(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
/** Returns a number, or NaN for null. */
double NumberFrom(const Json& json);
/** Returns an integer. @throws Error(kFormat) if it is not one that fits. */
int IntFrom(const Json& json);

/** Formats a value on one line or indented. */
inline std::string FormatJson(const Json& json, int indent = -1) { return json.dump(indent); }

Json JsonVector(const Eigen::Vector3d& v);
/** Returns a list of any length: joint angles, a point of a search. */
Json JsonAngles(const Eigen::VectorXd& q);
Eigen::VectorXd AnglesFrom(const Json& json);
/** Returns {"p_m": [x, y, z], "R": three rows}. The rotation is a matrix rather than a quaternion,
so that reading returns exactly the same pose. */
Json JsonPose(const Pose& X);
Eigen::Vector3d VectorFrom(const Json& json);
Pose PoseFrom(const Json& json);

}  // namespace graspbench
