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

and that one listing drives writing and reading JSON, and, for the fields with a FieldColumn, the
columns of a table with their schema. A field is a double (null: not finite), int, bool, text,
vector of angles, pose, another such struct, a vector of fields, or any type with ToJson(value) and
ReadJson(json, value) in its namespace. A field of a member that is a struct is listed with both
members, one that is no member with functions: Json(const Record&), void(const Json&, Record&) and,
to be read by record_text.h, void(JsonCursor&, Record&). With FieldMayMiss a number that is not
finite is left out instead of null; an optional member without a value is left out, too. */

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/text/csv.h"
#include "core/base/text/json.h"

namespace graspbench {

/** What a table says of a field besides its name and type. */
struct FieldColumn {
  const char* unit;     ///< "s", "m", ...; empty: none
  const char* meaning;  ///< one sentence
};

struct FieldMayMiss {};

template <class Record>
Json RecordToJson(const Record& record);
/** @throws Json::exception or Error(kFormat) when a key is missing or of another type. */
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

template <class Record>
struct FieldReader {
  const Json& json;
  Record& record;

  template <class T, class... About>
  void operator()(const char* key, T Record::*member, const About&...) const {
    ReadField(json.at(key), record.*member);
  }
  template <class T, class U>
  void operator()(const char* key, T Record::*outer, U T::*inner) const {
    ReadField(json.at(key), record.*outer.*inner);
  }
  template <class... About>
  void operator()(const char* key, double Record::*member, FieldMayMiss, const About&...) const {
    record.*member = json.contains(key) ? NumberFrom(json.at(key)) : std::nan("");
  }
  template <class T>
  void operator()(const char* key, std::optional<T> Record::*member) const {
    (record.*member).reset();
    if (json.contains(key)) ReadField(json.at(key), (record.*member).emplace());
  }
  template <class... Text>
  void operator()(const char* key, Json (*)(const Record&), void (*read)(const Json&, Record&),
                  const Text&...) const {
    read(json.at(key), record);
  }
};

}  // namespace internal

/** In the order of the listing. */
template <class Record>
Json RecordToJson(const Record& record) {
  Json json = Json::object();
  Record::ListFields(internal::FieldWriter<Record>{record, json});
  return json;
}

template <class Record>
void ReadRecord(const Json& json, Record& record) {
  Record::ListFields(internal::FieldReader<Record>{json, record});
}

/** A column of a table whose rows hold the record. @param take  const Record&(const Row&). */
template <class Row, class Record, class T, class Take>
CsvColumn<Row> MakeFieldColumn(const char* key, T Record::*member, const FieldColumn& about,
                               Take take) {
  return {key, internal::ColumnTypeOf<T>(), about.unit, about.meaning,
          [member, take](const Row& row) {
            const Json value = internal::FieldToJson(take(row).*member);
            return value.is_boolean() ? Json(value.get<bool>() ? 1 : 0) : value;
          }};
}

/** Takes the fields that have a column from a listing. @param take  const Record&(const Row&). */
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

/** Adds the columns of a record's fields. @param take  as above. */
template <class Record, class Row, class Take>
void AddFieldColumns(Take take, std::vector<CsvColumn<Row>>& columns) {
  Record::ListFields(FieldColumnCollector<Row, Record, Take>{columns, take});
}

}  // namespace graspbench
