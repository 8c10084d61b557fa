#pragma once
/** @file
Records as plain structs. A struct lists each of its fields once:

    struct Throw {
      double height = 0.0;  ///< [m]
      std::string reason;

      template <class V>
      static void ListFields(V&& field) {
        field("height_m", &Throw::height, FieldColumn{"m", "of the highest point"});
        field("reason", &Throw::reason);
      }
    };

This listing drives writing and reading JSON. For fields with a FieldColumn it also defines the
columns of a table and their schema.

A field is a double (null: not finite), int, bool, string, vector of angles, pose, another such
struct, a vector of fields, or any type with ToJson(value) and ReadJson(json, value) in its
namespace. A field of a nested struct is listed with both member pointers. A field that is not a
member is listed with functions: Json(const Record&), void(const Json&, Record&) and, for direct
reading from text, void(JsonCursor&, Record&). With FieldMayMiss a non-finite number is omitted
instead of written as null. An optional member without a value is omitted, too. */

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/text/csv.h"
#include "core/base/text/json.h"
#include "core/base/text/json_cursor.h"

namespace graspbench {

/** Attributes of a field's column in a table, besides its name and type. */
struct FieldColumn {
  const char* unit;     ///< "s", "m", ...; empty: none
  const char* meaning;  ///< one sentence
};

struct FieldMayMiss {};

template <class Record>
Json RecordToJson(const Record& record);
/** @throws Json::exception or Error(kFormat) if a key is missing or a value has the wrong type. */
template <class Record>
void ReadRecord(const Json& json, Record& record);

namespace internal {

struct AnyField {
  template <class... T>
  void operator()(const char*, T&&...) const {}
};
template <class T, class = void>
struct HasFields : std::false_type {};
template <class T>
struct HasFields<T, std::void_t<decltype(T::ListFields(AnyField()))>> : std::true_type {};

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};

template <class T>
Json FieldToJson(const T& value) {
  if constexpr (std::is_same_v<T, double>) {
    return JsonNumber(value);
  } else if constexpr (std::is_same_v<T, Eigen::VectorXd>) {
    return JsonAngles(value);
  } else if constexpr (std::is_same_v<T, Pose>) {
    return JsonPose(value);
  } else if constexpr (HasFields<T>::value) {
    return RecordToJson(value);
  } else if constexpr (IsVector<T>::value) {
    Json json = Json::array();
    for (const auto& item : value) json.push_back(FieldToJson(item));
    return json;
  } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
    return value;
  } else {
    return ToJson(value);
  }
}

template <class T>
void ReadField(const Json& json, T& value) {
  if constexpr (std::is_same_v<T, double>) {
    value = NumberFrom(json);
  } else if constexpr (std::is_same_v<T, int>) {
    value = IntFrom(json);
  } else if constexpr (std::is_same_v<T, Eigen::VectorXd>) {
    value = AnglesFrom(json);
  } else if constexpr (std::is_same_v<T, Pose>) {
    value = PoseFrom(json);
  } else if constexpr (HasFields<T>::value) {
    ReadRecord(json, value);
  } else if constexpr (IsVector<T>::value) {
    value.clear();
    for (const Json& item : json) ReadField(item, value.emplace_back());
  } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
    value = json.get<T>();
  } else {
    ReadJson(json, value);
  }
}

template <class Record>
struct FieldWriter {
  const Record& record;
  Json& json;

  template <class T, class... About>
  void operator()(const char* key, T Record::*member, const About&...) const {
    json[key] = FieldToJson(record.*member);
  }
  template <class T, class U>
  void operator()(const char* key, T Record::*outer, U T::*inner) const {
    json[key] = FieldToJson(record.*outer.*inner);
  }
  template <class... About>
  void operator()(const char* key, double Record::*member, FieldMayMiss, const About&...) const {
    if (std::isfinite(record.*member)) json[key] = record.*member;
  }
  template <class T>
  void operator()(const char* key, std::optional<T> Record::*member) const {
    if (record.*member) json[key] = FieldToJson(*(record.*member));
  }
  template <class... Text>
  void operator()(const char* key, Json (*write)(const Record&), void (*)(const Json&, Record&),
                  const Text&...) const {
    json[key] = write(record);
  }
};

/** Source of a record's fields: the members of a JSON object, by key. */
class JsonFields {
 public:
  explicit JsonFields(const Json& json) : json_(json) {}

  /** Returns whether the key exists; if so, its value is read next. */
  bool Find(const char* key) {
    next_ = json_.find(key);
    return next_ != nullptr;
  }
  void Demand(const char* key) { next_ = &json_.at(key); }
  template <class T>
  void Read(T& value) const {
    ReadField(*next_, value);
  }
  template <class Record, class... Text>
  void Call(Record& record, void (*read)(const Json&, Record&), const Text&...) const {
    read(*next_, record);
  }

 private:
  const Json& json_;
  const Json* next_ = nullptr;
};

template <class Source, class Record>
struct FieldReader {
  Source& source;
  Record& record;

  template <class T, class... About>
  void operator()(const char* key, T Record::*member, const About&...) const {
    source.Demand(key);
    source.Read(record.*member);
  }
  template <class T, class U>
  void operator()(const char* key, T Record::*outer, U T::*inner) const {
    source.Demand(key);
    source.Read(record.*outer.*inner);
  }
  template <class... About>
  void operator()(const char* key, double Record::*member, FieldMayMiss, const About&...) const {
    record.*member = std::nan("");
    if (source.Find(key)) source.Read(record.*member);
  }
  template <class T>
  void operator()(const char* key, std::optional<T> Record::*member) const {
    (record.*member).reset();
    if (source.Find(key)) source.Read((record.*member).emplace());
  }
  template <class... Text>
  void operator()(const char* key, Json (*)(const Record&), void (*read)(const Json&, Record&),
                  const Text&... read_text) const {
    source.Demand(key);
    source.Call(record, read, read_text...);
  }
};

}  // namespace internal

/** Writes the fields in the order of the listing. */
template <class Record>
Json RecordToJson(const Record& record) {
  Json json = Json::object();
  Record::ListFields(internal::FieldWriter<Record>{record, json});
  return json;
}

template <class Record>
void ReadRecord(const Json& json, Record& record) {
  internal::JsonFields fields(json);
  Record::ListFields(internal::FieldReader<internal::JsonFields, Record>{fields, record});
}

/** Makes a column of a table whose rows contain the record.
@param take  const Record&(const Row&). */
template <class Row, class Record, class T, class Take>
CsvColumn<Row> MakeFieldColumn(const char* key, T Record::*member, const FieldColumn& about,
                               Take take) {
  return {key, internal::ColumnTypeOf<T>(), about.unit, about.meaning,
          [member, take](const Row& row) {
            const Json value = internal::FieldToJson(take(row).*member);
            return value.is_boolean() ? Json(value.get<bool>() ? 1 : 0) : value;
          }};
}

/** Collects the columns of the fields that have one.
@param take  const Record&(const Row&). */
template <class Row, class Record, class Take>
struct FieldColumnCollector {
  std::vector<CsvColumn<Row>>& columns;
  Take take;

  template <class T>
  void operator()(const char* key, T Record::*member, const FieldColumn& about) const {
    columns.push_back(MakeFieldColumn<Row>(key, member, about, take));
  }
  template <class T>
  void operator()(const char* key, T Record::*member, FieldMayMiss,
                  const FieldColumn& about) const {
    columns.push_back(MakeFieldColumn<Row>(key, member, about, take));
  }
  template <class... Other>
  void operator()(const char*, const Other&...) const {}
};

/** Adds the columns of a record's fields.
@param take  as above. */
template <class Record, class Row, class Take>
void AddFieldColumns(Take take, std::vector<CsvColumn<Row>>& columns) {
  Record::ListFields(FieldColumnCollector<Row, Record, Take>{columns, take});
}

/** Reads the members of an object, without its braces, directly from text that RecordToJson and
FormatJson wrote, in the listing's order. At any deviation the cursor fails. The caller then parses
the text and uses ReadRecord, which also reports faults.
@pre `record` is default-constructed. */
template <class Record>
void ReadFieldsText(JsonCursor& text, Record& record, bool is_first = true);

template <class Record>
void ReadRecordText(JsonCursor& text, Record& record) {
  text.Demand("{");
  ReadFieldsText(text, record);
  text.Demand("}");
}

/** Reads a list item by item.
@param read  reads the next item. */
template <class Read>
void ReadListText(JsonCursor& text, Read read) {
  text.Demand("[");
  if (text.Take("]")) return;
  do {
    read();
  } while (text.Take(",") && !text.has_failed());
  text.Demand("]");
}

namespace internal {

inline void ReadNumbersText(JsonCursor& text, size_t count, double* values) {
  for (size_t i = 0; i < count; ++i) {
    text.Demand(i == 0 ? "[" : ",");
    values[i] = text.ReadNumber();
  }
  text.Demand("]");
}

inline void ReadPoseText(JsonCursor& text, Pose& pose) {
  Eigen::Vector3d p;
  Eigen::Matrix3d R_transposed;
  text.Demand("{\"p_m\":");
  ReadNumbersText(text, 3, p.data());
  for (int row = 0; row < 3; ++row) {
    text.Demand(row == 0 ? ",\"R\":[" : ",");
    ReadNumbersText(text, 3, R_transposed.col(row).data());
  }
  text.Demand("]}");
  if (!text.has_failed()) pose = MakePose(R_transposed.transpose(), p);
}

/** Reads a value through Json: an enumeration's name, a non-ASCII string, a rare type. */
template <class Use>
void UseJsonText(JsonCursor& text, Use use) {
  const Json json = Json::try_parse(text.ReadValue());
  if (text.has_failed() || json.is_discarded()) return text.Fail();
  try {
    use(json);
  } catch (const std::exception&) {  // from the JSON library, or an Error from a value
    text.Fail();
  }
}

template <class T>
void ReadFieldText(JsonCursor& text, T& value) {
  if (text.has_failed()) return;
  if constexpr (std::is_same_v<T, double>) {
    value = text.Take("null") ? std::nan("") : text.ReadNumber();
  } else if constexpr (std::is_same_v<T, int>) {
    value = text.ReadInt();
  } else if constexpr (std::is_same_v<T, bool>) {
    value = text.Take("true");
    if (!value) text.Demand("false");
  } else if constexpr (std::is_same_v<T, Eigen::VectorXd>) {
    std::vector<double> numbers;
    ReadListText(text, [&] { numbers.push_back(text.ReadNumber()); });
    value = Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                              static_cast<Eigen::Index>(numbers.size()));
  } else if constexpr (std::is_same_v<T, Pose>) {
    ReadPoseText(text, value);
  } else if constexpr (HasFields<T>::value) {
    ReadRecordText(text, value);
  } else if constexpr (IsVector<T>::value) {
    ReadListText(text, [&] { ReadFieldText(text, value.emplace_back()); });
  } else {
    JsonCursor ahead = text;
    const std::string_view plain = ahead.ReadPlainText();
    if (ahead.has_failed()) {
      UseJsonText(text, [&](const Json& json) { ReadField(json, value); });
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = plain;
      text = ahead;
    } else {
      try {
        ReadField(Json(plain), value);
        text = ahead;
      } catch (const std::exception&) {  // from the JSON library, or an Error from a value
        text.Fail();
      }
    }
  }
}

class TextFields {
 public:
  TextFields(JsonCursor& text, bool is_first) : text_(text), is_first_(is_first) {}

  bool Find(const char* key) {
    const bool is_there = text_.TakeKey(key, is_first_);
    is_first_ = is_first_ && !is_there;
    return is_there;
  }
  void Demand(const char* key) {
    if (!Find(key)) text_.Fail();
  }
  template <class T>
  void Read(T& value) const {
    ReadFieldText(text_, value);
  }
  template <class Record>
  void Call(Record& record, void (*)(const Json&, Record&),
            void (*read)(JsonCursor&, Record&)) const {
    if (!text_.has_failed()) read(text_, record);
  }

 private:
  JsonCursor& text_;
  bool is_first_;
};

}  // namespace internal

template <class Record>
void ReadFieldsText(JsonCursor& text, Record& record, bool is_first) {
  internal::TextFields fields(text, is_first);
  Record::ListFields(internal::FieldReader<internal::TextFields, Record>{fields, record});
}

}  // namespace graspbench
