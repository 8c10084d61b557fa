#include "core/base/text/json.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>
#include <ostream>

#include "core/base/whole_number.h"

namespace graspbench {
namespace {

using Library = nlohmann::ordered_json;

const char* NameOf(Json::Type type) {
  constexpr const char* kNames[] = {"null",   "boolean", "number", "number",   "number",
                                    "string", "array",   "object", "discarded"};
  return kNames[static_cast<size_t>(type)];
}

[[noreturn]] void FailJson(const std::string& code, const std::string& problem) {
  throw Json::exception("[json.exception." + code + "] " + problem);
}

/** Builds values from the events of the library's parser. Of repeated keys the last one counts. */
class TreeBuilder {
 public:
  Json Finish() { return std::move(root_); }
  /** The parser's error message; empty when there was none. */
  const std::string& fault() const { return fault_; }

  bool null() { return Add(nullptr); }
  bool boolean(bool value) { return Add(value); }
  bool number_integer(int64_t value) { return Add(value); }
  bool number_unsigned(uint64_t value) { return Add(value); }
  bool number_float(double value, const std::string&) { return Add(value); }
  bool string(std::string& value) { return Add(std::move(value)); }
  bool binary(Library::binary_t&) { return false; }  // does not occur in text
  bool start_object(size_t) { return Open(Json::object()); }
  bool key(std::string& key) {
    next_ = &(*open_.back())[key];
    return true;
  }
  bool end_object() { return Close(); }
  bool start_array(size_t) { return Open(Json::array()); }
  bool end_array() { return Close(); }
  bool parse_error(size_t, const std::string&, const Library::exception& fault) {
    fault_ = fault.what();
    return false;
  }

 private:
  bool Add(Json value) {
    if (!open_.empty() && open_.back()->is_array()) {
      open_.back()->push_back(std::move(value));
      next_ = &open_.back()->back();
    } else {
      *next_ = std::move(value);
    }
    return true;
  }
  bool Open(Json value) {
    Add(std::move(value));
    open_.push_back(next_);
    return true;
  }
  bool Close() {
    open_.pop_back();
    return true;
  }

  Json root_;
  Json* next_ = &root_;      ///< receives the next value outside lists
  std::vector<Json*> open_;  ///< open lists and objects, the innermost last
  std::string fault_;
};

/** Copies printable ASCII as it is; the library encodes all other texts. */
void AppendString(const std::string& value, std::string& text) {
  const auto is_plain = [](char c) {
    return static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x80 &&
           c != '"' && c != '\\';
  };
  if (std::all_of(value.begin(), value.end(), is_plain)) {
    text += '"';
    text += value;
    text += '"';
  } else {
    text += Library(value).dump(-1, ' ', false, Library::error_handler_t::replace);
  }
}

template <class T>
void AppendInteger(T value, std::string& text) {
  char digits[24];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void AppendFloat(double value, std::string& text) {
  if (!std::isfinite(value)) {
    text += "null";
    return;
  }
  char digits[64];
  text.append(digits, nlohmann::detail::to_chars(digits, digits + sizeof digits, value));
}

/** @param indent  negative: one line. @param depth  spaces before the lines of the value. */
void Append(const Json& json, int indent, int depth, std::string& text);

/** @param append  appends one item. */
template <class Items, class AppendItem>
void AppendList(const Items& items, char open, char close, int indent, int depth, std::string& text,
                AppendItem append) {
  text += open;
  const auto break_line = [&](int spaces) {
    if (indent < 0) return;
    text += '\n';
    text.append(static_cast<size_t>(spaces), ' ');
  };
  for (const auto& item : items) {
    if (&item != &*items.begin()) text += ',';
    break_line(depth + indent);
    append(item);
  }
  if (items.begin() != items.end()) break_line(depth);
  text += close;
}

void Append(const Json& json, int indent, int depth, std::string& text) {
  switch (json.type()) {
    case Json::Type::kNull:
      text += "null";
      break;
    case Json::Type::kBoolean:
      text += json.get<bool>() ? "true" : "false";
      break;
    case Json::Type::kInteger:
      AppendInteger(json.get<long>(), text);
      break;
    case Json::Type::kUnsigned:
      AppendInteger(json.get<unsigned long>(), text);
      break;
    case Json::Type::kFloat:
      AppendFloat(json.get<double>(), text);
      break;
    case Json::Type::kString:
      AppendString(json.str(), text);
      break;
    case Json::Type::kArray:
      AppendList(json, '[', ']', indent, depth, text,
                 [&](const Json& item) { Append(item, indent, depth + indent, text); });
      break;
    case Json::Type::kObject:
      AppendList(json.items(), '{', '}', indent, depth, text, [&](const auto& member) {
        AppendString(member.first, text);
        text += indent < 0 ? ":" : ": ";
        Append(member.second, indent, depth + indent, text);
      });
      break;
    case Json::Type::kDiscarded:
      text += "<discarded>";
      break;
  }
}

}  // namespace

Json::Json(std::string value) : type_(Type::kString) {
  string_ = new std::string(std::move(value));
}
Json::Json(array_t items) : type_(Type::kArray) { array_ = new array_t(std::move(items)); }
Json::Json(object_t members) : type_(Type::kObject) { object_ = new object_t(std::move(members)); }

Json::Json(std::initializer_list<JsonItem> items) {
  const bool is_object = std::all_of(items.begin(), items.end(), [](const JsonItem& item) {
    return item.value.is_array() && item.value.size() == 2 && item.value[0].is_string();
  });
  if (!is_object) {
    *this = array(items);
    return;
  }
  *this = object();
  for (const JsonItem& item : items) {
    // The first of several equal keys counts.
    if (!contains(item.value[0].str())) (*this)[item.value[0].str()] = std::move(item.value[1]);
  }
}

Json Json::array(std::initializer_list<JsonItem> items) {
  Json json = array();
  json.array_->reserve(items.size());
  for (const JsonItem& item : items) json.array_->push_back(std::move(item.value));
  return json;
}

Json::Json(const Json& other) : type_(other.type_), integer_(other.integer_) {
  if (type_ == Type::kString) string_ = new std::string(*other.string_);
  if (type_ == Type::kArray) array_ = new array_t(*other.array_);
  if (type_ == Type::kObject) object_ = new object_t(*other.object_);
}

void Json::Destroy() {
  // A loop, not recursion: a text may nest values deeper than the stack allows.
  std::vector<Json> inner;
  const auto take = [&inner](Json& json) {
    for (Json& item : json) {
      if (!item.empty() && (item.is_array() || item.is_object())) inner.push_back(std::move(item));
    }
  };
  if (is_array() || is_object()) take(*this);
  while (!inner.empty()) {
    Json json = std::move(inner.back());
    inner.pop_back();
    take(json);
  }
  if (type_ == Type::kString) delete string_;
  if (type_ == Type::kArray) delete array_;
  if (type_ == Type::kObject) delete object_;
}

Json Json::parse(std::string_view text) {
  TreeBuilder builder;
  if (!Library::sax_parse(text.begin(), text.end(), &builder)) throw exception(builder.fault());
  return builder.Finish();
}

Json Json::try_parse(std::string_view text) {
  TreeBuilder builder;
  if (Library::sax_parse(text.begin(), text.end(), &builder)) return builder.Finish();
  Json json;
  json.type_ = Type::kDiscarded;
  return json;
}

std::string Json::dump(int indent) const {
  std::string text;
  Append(*this, indent, 0, text);
  return text;
}

std::ostream& operator<<(std::ostream& out, const Json& json) { return out << json.dump(); }

void Json::FailType(const char* expected) const {
  FailJson("type_error.302", "type must be " + std::string(expected) + ", but is " + NameOf(type_));
}
void Json::FailUse(int code, const char* use) const {
  FailJson("type_error." + std::to_string(code),
           "cannot use " + std::string(use) + " with " + NameOf(type_));
}

template <class T>
T Json::GetNumber() const {
  if (type_ == Type::kInteger) return static_cast<T>(integer_);
  if (type_ == Type::kUnsigned) return static_cast<T>(unsigned_);
  if (type_ == Type::kFloat) {
    if constexpr (std::is_floating_point_v<T>) return float_;
    if constexpr (!std::is_floating_point_v<T>) return ToWhole<T>(float_);
  }
  FailType("number");
}

template <>
bool Json::get<bool>() const {
  if (!is_boolean()) FailType("boolean");
  return boolean_;
}
template <>
int Json::get<int>() const {
  return is_boolean() ? int{boolean_} : GetNumber<int>();
}
template <>
long Json::get<long>() const {
  return GetNumber<long>();
}
template <>
long long Json::get<long long>() const {
  return GetNumber<long long>();
}
template <>
unsigned long Json::get<unsigned long>() const {
  return GetNumber<unsigned long>();
}
template <>
double Json::get<double>() const {
  return GetNumber<double>();
}
template <>
std::string Json::get<std::string>() const {
  return str();
}
template <>
Json Json::get<Json>() const {
  return *this;
}
template <>
std::vector<std::string> Json::get<std::vector<std::string>>() const {
  if (!is_array()) FailType("array");
  std::vector<std::string> texts;
  for (const Json& item : *array_) texts.push_back(item.str());
  return texts;
}
template <>
std::vector<double> Json::get<std::vector<double>>() const {
  if (!is_array()) FailType("array");
  std::vector<double> numbers;
  for (const Json& item : *array_) numbers.push_back(item.get<double>());
  return numbers;
}
template <>
std::map<std::string, std::string> Json::get<std::map<std::string, std::string>>() const {
  if (!is_object()) FailType("object");
  std::map<std::string, std::string> texts;
  for (const auto& [key, item] : *object_) texts.emplace(key, item.str());
  return texts;
}

const std::string& Json::str() const {
  if (!is_string()) FailType("string");
  return *string_;
}

size_t Json::size() const {
  if (is_array()) return array_->size();
  if (is_object()) return object_->size();
  return is_null() ? 0 : 1;
}

const Json::object_t& Json::items() const {
  static const object_t kNone;
  if (is_null()) return kNone;
  if (!is_object()) FailType("object");
  return *object_;
}
Json::object_t& Json::items() {
  if (is_null()) *this = object();
  return const_cast<object_t&>(std::as_const(*this).items());
}

const Json* Json::find(std::string_view key) const {
  if (!is_object()) return nullptr;
  for (const auto& member : *object_) {
    if (member.first == key) return &member.second;
  }
  return nullptr;
}

const Json& Json::at(size_t index) const {
  if (!is_array()) FailUse(304, "at()");
  if (index >= array_->size()) {
    FailJson("out_of_range.401", "array index " + std::to_string(index) + " is out of range");
  }
  return (*array_)[index];
}
const Json& Json::at(std::string_view key) const {
  if (!is_object()) FailUse(304, "at()");
  const Json* const found = find(key);
  if (found == nullptr) FailJson("out_of_range.403", "key '" + std::string(key) + "' not found");
  return *found;
}
const Json& Json::operator[](size_t index) const {
  if (!is_array()) FailUse(305, "operator[] with a numeric argument");
  return at(index);
}
const Json& Json::operator[](std::string_view key) const {
  if (!is_object()) FailUse(305, "operator[] with a string argument");
  return at(key);
}
Json& Json::operator[](std::string_view key) {
  if (is_null()) *this = object();
  if (!is_object()) FailUse(305, "operator[] with a string argument");
  if (const Json* const found = find(key)) return const_cast<Json&>(*found);
  return object_->emplace_back(key, nullptr).second;
}

std::string Json::value(std::string_view key, const char* fallback) const {
  return value(key, std::string(fallback));
}

void Json::push_back(Json item) {
  if (is_null()) *this = array();
  if (!is_array()) FailUse(308, "push_back()");
  array_->push_back(std::move(item));
}

void Json::update(const Json& other) {
  if (is_null()) *this = object();
  if (!is_object()) FailUse(312, "update()");
  if (!other.is_object()) other.FailUse(312, "update()");
  for (const auto& [key, item] : *other.object_) (*this)[key] = item;
}

void Json::emplace(std::string_view key, Json item) {
  if (is_null()) *this = object();
  if (!is_object()) FailUse(311, "emplace()");
  if (!contains(key)) object_->emplace_back(key, std::move(item));
}

void Json::erase(std::string_view key) {
  if (!is_object()) FailUse(307, "erase()");
  const auto is_it = [key](const auto& member) { return member.first == key; };
  object_->erase(std::remove_if(object_->begin(), object_->end(), is_it), object_->end());
}

bool Json::IsEqual(const Json& other) const {
  if (is_number() && other.is_number()) {
    if (type_ == Type::kFloat || other.type_ == Type::kFloat) {
      return get<double>() == other.get<double>();
    }
    return integer_ == other.integer_;
  }
  if (type_ != other.type_) return false;
  switch (type_) {
    case Type::kBoolean:
      return boolean_ == other.boolean_;
    case Type::kString:
      return *string_ == *other.string_;
    case Type::kArray:
      return *array_ == *other.array_;
    case Type::kObject:
      return *object_ == *other.object_;
    default:
      return is_null();
  }
}

double NumberFrom(const Json& json) { return json.is_null() ? std::nan("") : json.get<double>(); }

int IntFrom(const Json& json) {
  const double value = json.is_number_integer() ? json.get<double>() : std::nan("");
  if (!(std::abs(value) <= std::numeric_limits<int>::max())) {
    throw Error(ErrorKind::kFormat, "expected a whole number");
  }
  return json.get<int>();
}

Json JsonVector(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }
Json JsonAngles(const Eigen::VectorXd& q) { return std::vector<double>(q.begin(), q.end()); }
Eigen::VectorXd AnglesFrom(const Json& json) {
  const auto values = json.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}
Json JsonPose(const Pose& X) {
  const Eigen::Matrix3d R = X.linear();
  return Json{{"p_m", JsonVector(X.translation())},
              {"R", {JsonVector(R.row(0)), JsonVector(R.row(1)), JsonVector(R.row(2))}}};
}
Eigen::Vector3d VectorFrom(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}
Pose PoseFrom(const Json& json) {
  Eigen::Matrix3d R;
  for (int row = 0; row < 3; ++row)
    R.row(row) = VectorFrom(json.at("R").at(static_cast<size_t>(row)));
  return MakePose(R, VectorFrom(json.at("p_m")));
}

}  // namespace graspbench
