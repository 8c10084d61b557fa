#pragma once
/** @file
Records (record_fields.h) straight from the text that RecordToJson and FormatJson made of them, in
the listing's order. Where the text is not just so, the cursor fails, and ReadRecord of the parsed
text has the last word, about its faults too. */

#include <vector>

#include "core/base/text/json_cursor.h"
#include "core/base/text/record_fields.h"

namespace graspbench {

/** The members of an object, without its braces. @pre `record` is new. */
template <class Record>
void ReadFieldsText(JsonCursor& text, Record& record, bool is_first = true);

template <class Record>
void ReadRecordText(JsonCursor& text, Record& record) {
  text.Demand("{");
  ReadFieldsText(text, record);
  text.Demand("}");
}

/** One record after the other until the list's end. @param read  of the next one. */
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

/** By way of JSON: an enumeration's name, a text with other letters than ASCII, a rare type. */
template <class Use>
void UseJsonText(JsonCursor& text, Use use) {
  const Json json = Json::try_parse(text.ReadValue());
  if (text.has_failed() || json.is_discarded()) return text.Fail();
  try {
    use(json);
  } catch (const std::exception&) {  // of the JSON library, or an Error of a value
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
      } catch (const std::exception&) {  // of the JSON library, or an Error of a value
        text.Fail();
      }
    }
  }
}

template <class Record>
struct TextFieldReader {
  JsonCursor& text;
  Record& record;
  bool& is_first;

  bool TakeKey(const char* key) const {
    const bool is_there = text.TakeKey(key, is_first);
    is_first = is_first && !is_there;
    return is_there;
  }
  template <class T>
  void ReadMember(const char* key, T& value) const {
    if (!TakeKey(key)) return text.Fail();
    ReadFieldText(text, value);
  }

  template <class T, class... About>
  void operator()(const char* key, T Record::*member, const About&...) const {
    ReadMember(key, record.*member);
  }
  template <class T, class U>
  void operator()(const char* key, T Record::*outer, U T::*inner) const {
    ReadMember(key, record.*outer.*inner);
  }
  template <class... About>
  void operator()(const char* key, double Record::*member, FieldMayMiss, const About&...) const {
    record.*member = std::nan("");
    if (TakeKey(key)) ReadFieldText(text, record.*member);
  }
  template <class T>
  void operator()(const char* key, std::optional<T> Record::*member) const {
    if (TakeKey(key)) ReadFieldText(text, (record.*member).emplace());
  }
  void operator()(const char* key, Json (*)(const Record&), void (*)(const Json&, Record&),
                  void (*read)(JsonCursor&, Record&)) const {
    if (!TakeKey(key)) return text.Fail();
    read(text, record);
  }
};

}  // namespace internal

template <class Record>
void ReadFieldsText(JsonCursor& text, Record& record, bool is_first) {
  Record::ListFields(internal::TextFieldReader<Record>{text, record, is_first});
}

}  // namespace graspbench
