#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/human_study/faults.h"
#include "tests/human_study/recording/synthetic_recording.h"
#include "tests/support/shared_data.h"

namespace graspbench {
namespace {

constexpr C3dProcessor kProcessors[] = {C3dProcessor::kIntel, C3dProcessor::kDec,
                                        C3dProcessor::kMips};

/** Where the name of a group or parameter stands. */
size_t FindName(const std::string& bytes, const std::string& name) {
  for (size_t at = bytes.find(name); at != std::string::npos; at = bytes.find(name, at + 1)) {
    if (at >= 2 && static_cast<size_t>(bytes[at - 2]) == name.size()) return at;
  }
  ADD_FAILURE() << "no parameter " << name;
  return 0;
}

/** First data byte of a parameter. */
size_t FindParameter(const std::string& bytes, const std::string& name) {
  const size_t type = FindName(bytes, name) + name.size() + 2;
  return type + 2 + static_cast<uint8_t>(bytes[type + 1]);
}

void SetWord(std::string& bytes, size_t at, uint16_t value) {
  std::string word;
  AppendC3dWord(word, C3dProcessor::kIntel, value);
  bytes.replace(at, 2, word);
}

void SetFloat(std::string& bytes, size_t at, float value) {
  std::string number;
  AppendC3dFloat(number, C3dProcessor::kIntel, value);
  bytes.replace(at, 4, number);
}

void Rename(std::string& bytes, const std::string& name) { bytes[FindName(bytes, name)] = '#'; }

size_t FindData(const std::string& bytes) {
  return (DecodeC3dWord(C3dProcessor::kIntel, reinterpret_cast<const uint8_t*>(&bytes[16])) - 1u) *
         kC3dBlock;
}

TEST(C3dFormat, DecFloatsFollowTheVaxManual) {
  // VAX F: 1.0 is 0x4080 in the first word, 0 in the second; the words stand low byte first.
  const uint8_t one[4] = {0x80, 0x40, 0x00, 0x00};
  EXPECT_EQ(DecodeC3dFloat(C3dProcessor::kDec, one), 1.0f);
  const uint8_t minus_12_5[4] = {0x48, 0xc2, 0x00, 0x00};
  EXPECT_EQ(DecodeC3dFloat(C3dProcessor::kDec, minus_12_5), -12.5f);
  for (const float value : {0.0f, 1.0f, -3.14159f, 1e-30f, 8.5e37f, -0.08333334f}) {
    for (const C3dProcessor processor : kProcessors) {
      std::string bytes;
      AppendC3dFloat(bytes, processor, value);
      EXPECT_EQ(DecodeC3dFloat(processor, reinterpret_cast<const uint8_t*>(bytes.data())), value);
    }
  }
}

TEST(C3dImporter, FloatRoundTripKeepsEveryBitOnEveryProcessor) {
  const Recording original = MakeSyntheticRecording(60, 5);
  for (const C3dProcessor processor : kProcessors) {
    C3dWriteOptions options;
    options.processor = processor;
    options.scale = 0.1;
    const Recording read = ImportBytes(FormatC3d(original, options), "c3d");
    EXPECT_TRUE(read.findings.empty()) << read.findings[0].text;
    EXPECT_EQ(read.first_frame, 5);
    EXPECT_DOUBLE_EQ(read.Time(0), 0.04);
    ASSERT_EQ(read.num_frames, 60u);
    ASSERT_EQ(read.points.size(), 5u);
    for (size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(read.points[i].label, original.points[i].label);
      EXPECT_EQ(read.points[i].states, original.points[i].states);
      for (size_t k = 0; k < 180; ++k) {
        if (std::isnan(original.points[i].xyz[k])) {
          EXPECT_TRUE(std::isnan(read.points[i].xyz[k]));
        } else {
          EXPECT_EQ(read.points[i].xyz[k], original.points[i].xyz[k]);
        }
      }
    }
    EXPECT_FLOAT_EQ(read.points[0].residuals[0], 0.5f);
    ASSERT_EQ(read.analog.size(), 2u);
    EXPECT_EQ(read.analog[1].samples, original.analog[1].samples);
    EXPECT_EQ(read.analog[1].rate, 400.0);
    ASSERT_EQ(read.events.size(), 4u);
    EXPECT_EQ(read.events[1].label, "lift");
    EXPECT_EQ(read.events[1].context, "Right");
    EXPECT_FLOAT_EQ(read.events[1].time, 75.5f) << "minutes and seconds";
    EXPECT_EQ(read.events[3].label, "RTO");
    EXPECT_EQ(read.events[3].source, EventSource::kHeader);
    EXPECT_FLOAT_EQ(read.events[3].time, 2.25f);
  }
}

TEST(C3dImporter, IntegerRoundTripStaysWithinHalfAStep) {
  const Recording original = MakeSyntheticRecording(60, 5);
  for (const C3dProcessor processor : kProcessors) {
    for (const bool is_unsigned : {false, true}) {
      C3dWriteOptions options;
      options.processor = processor;
      options.is_float = false;
      options.scale = 0.1;
      options.analog_is_unsigned = is_unsigned;
      const Recording read = ImportBytes(FormatC3d(original, options), "c3d");
      for (size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(read.points[i].states, original.points[i].states);
        for (size_t k = 0; k < 180; ++k) {
          if (std::isnan(original.points[i].xyz[k])) continue;
          EXPECT_NEAR(read.points[i].xyz[k], original.points[i].xyz[k], 0.0501);
        }
      }
      for (size_t k = 0; k < original.analog[1].samples.size(); ++k) {
        EXPECT_NEAR(read.analog[1].samples[k], original.analog[1].samples[k], 2.0 / 32000);
      }
    }
  }
}

TEST(C3dImporter, ParametersMayStandAnywhere) {
  C3dWriteOptions options;
  options.parameter_block = 11;
  const Recording read = ImportBytes(FormatC3d(MakeSyntheticRecording(9, 2), options), "c3d");
  EXPECT_EQ(read.num_frames, 9u);
  EXPECT_TRUE(read.findings.empty());
}

TEST(C3dImporter, CountsBeyondAWordInBothStorages) {
  for (const bool is_float : {true, false}) {
    C3dWriteOptions options;
    options.is_float = is_float;
    Recording original = MakeSyntheticRecording(72610, 1);
    original.first_frame = 1;
    const Recording read = ImportBytes(FormatC3d(original, options), "c3d");
    EXPECT_EQ(read.num_frames, 72610u);
    EXPECT_TRUE(read.findings.empty());
    EXPECT_EQ(read.points[0].CountStates(SampleState::kInvalid),
              original.points[0].CountStates(SampleState::kInvalid));
  }
}

// Writers that store the frame count in a 16-bit place alone: it stays at its end or begins again.
TEST(C3dImporter, TheSizeOfTheFileCountsWhereSixteenBitsCannot) {
  const Recording original = MakeSyntheticRecording(72610, 1);
  const auto hide = [](std::string& bytes, const std::string& name) {
    bytes.replace(bytes.find(name), name.size(), std::string(name.size(), 'Z'));
  };
  std::string bytes = FormatC3d(original);
  for (const char* name : {"LONG_FRAMES", "ACTUAL_START_FIELD", "ACTUAL_END_FIELD"}) {
    hide(bytes, name);
  }
  const Recording saturated = ImportBytes(bytes, "c3d");
  constexpr size_t kPadding = 512 / 48;  // frames that fit into the rest of the last block
  EXPECT_GE(saturated.num_frames, 72610u);
  EXPECT_LE(saturated.num_frames, 72610u + kPadding);
  EXPECT_EQ(CountFindings(saturated, "frame_count_from_size"), 1u);
  EXPECT_EQ(saturated.points[0].Position(72609), original.points[0].Position(72609));
}

TEST(C3dImporter, ATruncatedLongFileIsNotTakenForASaturatedOne) {
  Recording original = MakeSyntheticRecording(72610, 1);
  original.analog.clear();
  std::string bytes = FormatC3d(original);
  bytes.resize(FindData(bytes) + 66000 * 16);
  ExpectHolds(ImportFault(bytes, "c3d"), "promises 72610 frames of 16 bytes, the file holds 66000");
  ImportOptions options;
  options.accept_truncated = true;
  const Recording read = ImportBytes(bytes, "c3d", options);
  EXPECT_EQ(read.num_frames, 66000u);
  EXPECT_EQ(CountFindings(read, "truncated"), 1u);
}

TEST(C3dImporter, LabelsBeyond255ContinueInLabels2) {
  const Recording read = ImportBytes(FormatC3d(MakeSyntheticRecording(3, 600)), "c3d");
  ASSERT_EQ(read.points.size(), 600u);
  EXPECT_EQ(read.points[599].label, "P600");
  EXPECT_TRUE(read.findings.empty());
}

TEST(C3dImporter, RepeatedAndMissingLabelsAreNoted) {
  Recording original = MakeSyntheticRecording(3, 4);
  original.points[1].label = original.points[2].label = "T8";
  original.points[0].label = "T8_2";
  original.points[3].label = "";
  const Recording read = ImportBytes(FormatC3d(original), "c3d");
  EXPECT_EQ(read.points[1].label, "T8");
  EXPECT_EQ(read.points[2].label, "T8_3") << "T8_2 is taken";
  EXPECT_EQ(read.points[3].label, "point_4");
  EXPECT_EQ(CountFindings(read, "duplicate_label"), 1u);
  EXPECT_EQ(CountFindings(read, "missing_label"), 1u);
}

TEST(C3dImporter, TextsComeOutSafeToPrint) {
  Recording original = MakeSyntheticRecording(3, 4);
  original.points[0].label =
      "Daumen gr\xf6\xdf"
      "er";  // Latin-1
  original.points[1].label =
      "Daumen gr\xc3\xb6\xc3\x9f"
      "er";
  original.points[2].label = "\x1b[31mred";
  const Recording read = ImportBytes(FormatC3d(original), "c3d");
  EXPECT_EQ(read.points[0].label,
            "Daumen gr\xc3\xb6\xc3\x9f"
            "er");
  EXPECT_EQ(read.points[1].label,
            "Daumen gr\xc3\xb6\xc3\x9f"
            "er_2")
      << "unique all the same";
  EXPECT_EQ(read.points[2].label, "?[31mred");
  EXPECT_EQ(CountFindings(read, "text_encoding"), 1u);
}

TEST(C3dImporter, FirstFrameMayBeZero) {
  Recording original = MakeSyntheticRecording(20, 1);
  original.first_frame = 0;
  const Recording read = ImportBytes(FormatC3d(original), "c3d");
  EXPECT_EQ(read.first_frame, 0);
  EXPECT_EQ(read.num_frames, 20u);
}

TEST(C3dImporter, AMissingUnitIsAskedForNotGuessed) {
  std::string bytes = FormatC3d(MakeSyntheticRecording(3, 2));
  Rename(bytes, "UNITS");
  const Recording read = ImportBytes(bytes, "c3d");
  EXPECT_EQ(CountFindings(read, "unit_missing"), 1u);
  EXPECT_TRUE(std::isnan(read.points[0].Position(0).x()));
  EXPECT_THROW(CheckLengthUnits(read, "file"), Error);
  ImportOptions options;
  options.unit = "cm";
  EXPECT_NEAR(ImportBytes(bytes, "c3d", options).points[0].Position(0).x(), 3.0, 1e-6);
}

TEST(C3dImporter, OnlyNegativeResidualsDoNotEmptyATrial) {
  Recording original = MakeSyntheticRecording(10, 2);
  std::string bytes = FormatC3d(original);
  const size_t frame_size = (2 * 4 + 8) * 4;
  for (size_t frame = 0; frame < 10; ++frame) {
    for (size_t i = 0; i < 2; ++i) {
      SetFloat(bytes, FindData(bytes) + frame * frame_size + 16 * i + 12, -1.0f);
    }
  }
  const Recording read = ImportBytes(bytes, "c3d");
  EXPECT_EQ(CountFindings(read, "all_residuals_negative"), 1u);
  EXPECT_EQ(read.points[0].CountStates(SampleState::kMeasured), 10u);
  EXPECT_EQ(read.points[1].CountStates(SampleState::kInvalid), 1u) << "(0, 0, 0) stays invalid";
  ImportOptions options;
  options.trust_residuals = true;
  EXPECT_EQ(ImportBytes(bytes, "c3d", options).points[0].CountStates(SampleState::kInvalid), 10u);
}

TEST(C3dImporter, OriginAndNanAreInvalidWhateverTheResidualSays) {
  Recording original = MakeSyntheticRecording(10, 2);
  original.analog.clear();
  std::string bytes = FormatC3d(original);
  const size_t data = FindData(bytes);
  for (size_t k = 0; k < 3; ++k) SetFloat(bytes, data + 4 * k, 0.0f);
  SetFloat(bytes, data + 32, std::nanf(""));
  const Recording read = ImportBytes(bytes, "c3d");
  EXPECT_EQ(read.points[0].states[0], SampleState::kInvalid);
  EXPECT_EQ(read.points[0].states[1], SampleState::kInvalid);
  EXPECT_EQ(read.points[0].states[2], SampleState::kMeasured);
  EXPECT_EQ(CountFindings(read, "zero_coordinates"), 1u);
  EXPECT_EQ(CountFindings(read, "not_finite"), 1u);
}

TEST(C3dImporter, ContradictionsAreNotedAndTheSizeOfTheFileDecides) {
  std::string bytes = FormatC3d(MakeSyntheticRecording(40, 3));
  SetWord(bytes, FindParameter(bytes, "FRAMES"), 30);
  SetWord(bytes, FindParameter(bytes, "ACTUAL_END_FIELD"), 65535);  // -1, 0
  SetFloat(bytes, 20, 50.0f);
  SetWord(bytes, 2, 4);
  SetWord(bytes, FindParameter(bytes, "DATA_START"), 0);
  const Recording read = ImportBytes(bytes, "c3d");
  EXPECT_EQ(read.num_frames, 40u);
  EXPECT_EQ(read.rate, 100.0);
  EXPECT_EQ(read.points.size(), 3u);
  for (const char* code :
       {"frame_count_disputed", "rate_disputed", "point_count_disputed", "data_start_disputed"}) {
    EXPECT_EQ(CountFindings(read, code), 1u) << code;
  }
}

TEST(C3dImporter, ARateOfNoRecordingIsNotTaken) {
  for (const float rate : {3e38f, 2e6f, 1e-7f, -1.0f}) {
    std::string bytes = FormatC3d(MakeSyntheticRecording(40, 3));
    SetFloat(bytes, FindParameter(bytes, "RATE"), rate);
    const Recording read = ImportBytes(bytes, "c3d");
    EXPECT_EQ(read.rate, 100.0) << rate;
    EXPECT_GE(CountFindings(read, "missing_parameter"), 1u) << rate;
  }
}

TEST(C3dImporter, AFileWithoutAnyParametersIsReadByItsHeader) {
  std::string bytes = FormatC3d(MakeSyntheticRecording(40, 3));
  bytes[512 + 4] = '\0';
  ImportOptions options;
  options.unit = "mm";
  const Recording read = ImportBytes(bytes, "c3d", options);
  EXPECT_EQ(read.num_frames, 40u);
  EXPECT_EQ(read.points.size(), 3u);
  EXPECT_EQ(read.points[0].label, "point_1");
  EXPECT_EQ(read.analog.size(), 2u);
  EXPECT_EQ(read.rate, 100.0);
}

TEST(C3dImporter, AnalogAloneIsARecording) {
  Recording original = MakeSyntheticRecording(40, 0);
  const Recording read = ImportBytes(FormatC3d(original), "c3d");
  EXPECT_TRUE(read.points.empty());
  EXPECT_EQ(read.analog[0].samples, original.analog[0].samples);
}

TEST(C3dImporter, EventsWithoutContextsKeepTheirTimes) {
  std::string bytes = FormatC3d(MakeSyntheticRecording(5, 1));
  Rename(bytes, "CONTEXTS");
  const Recording read = ImportBytes(bytes, "c3d");
  ASSERT_EQ(read.events.size(), 4u);
  EXPECT_EQ(read.events[1].context, "");
  EXPECT_FLOAT_EQ(read.events[1].time, 75.5f);
}

/** Turns the words of the parameter at `name` into these floats. */
void SetFloats(std::string& bytes, size_t name, const std::string& text,
               const std::vector<float>& values) {
  const size_t pointer = name + text.size(), type = pointer + 2;
  const size_t data = type + 2 + static_cast<uint8_t>(bytes[type + 1]);
  const size_t grown = 2 * values.size(), end = FindData(bytes);
  ASSERT_EQ(bytes.substr(end - grown, grown), std::string(grown, '\0')) << "no room";
  std::string floats;
  for (const float value : values) AppendC3dFloat(floats, C3dProcessor::kIntel, value);
  const auto distance =
      DecodeC3dWord(C3dProcessor::kIntel, reinterpret_cast<const uint8_t*>(&bytes[pointer]));
  SetWord(bytes, pointer, static_cast<uint16_t>(distance + grown));
  bytes[type] = 4;
  bytes.erase(end - grown, grown);
  bytes.replace(data, 2 * values.size(), floats);
}

constexpr float kNoCounts[] = {-1.0f, -1e30f, 1e30f, NAN, INFINITY, -INFINITY};

TEST(C3dImporter, AnEventCountThatIsNoneIsNotedAndNotTaken) {
  const std::string good = FormatC3d(MakeSyntheticRecording(60, 5));
  for (const float value : kNoCounts) {
    std::string bytes = good;
    SetFloats(bytes, bytes.find("USED", FindName(bytes, "EVENT")), "USED", {value});
    const Recording read = ImportBytes(bytes, "c3d");
    ASSERT_EQ(read.findings.size(), 1u) << value;
    EXPECT_EQ(read.findings[0].where, "EVENT:USED");
    EXPECT_EQ(read.findings[0].text.find("counts "), 0u);
    EXPECT_EQ(read.events.size(), 4u) << "those of EVENT:TIMES and of the header";
  }
}

TEST(C3dImporter, FrameNumbersThatAreNoneAreLeftOut) {
  const std::string good = FormatC3d(MakeSyntheticRecording(60, 5));
  for (const float value : kNoCounts) {
    std::string bytes = good;
    SetFloats(bytes, FindName(bytes, "ACTUAL_START_FIELD"), "ACTUAL_START_FIELD", {value, 0.0f});
    const Recording read = ImportBytes(bytes, "c3d");
    EXPECT_EQ(read.first_frame, 5) << value << ": the header's";
    EXPECT_EQ(read.num_frames, 60u);
  }
}

TEST(C3dImporter, AStrangersEventCountsAreReported) {
  for (const char* name : {"event_used_neg.c3d", "event_used_nan.c3d"}) {
    const std::filesystem::path file = FindSharedData() / "strangers" / "files" / name;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "shared data are not here";
    const Recording read = LoadRecording(file);
    EXPECT_EQ(std::count_if(read.findings.begin(), read.findings.end(),
                            [](const auto& f) { return f.where == "EVENT:USED"; }),
              1)
        << name;
  }
}

TEST(C3dImporter, BrokenFilesAreRefusedWithTheirByte) {
  const std::string good = FormatC3d(MakeSyntheticRecording(40, 3));
  const auto broken = [&](auto break_it) {
    std::string bytes = good;
    break_it(bytes);
    return ImportFault(bytes, "c3d");
  };
  EXPECT_EQ(ImportFault(good.substr(0, 511), "c3d"),
            "file: byte 511: the file ends here; a C3D header alone has 512 bytes");
  EXPECT_EQ(
      broken([](std::string& b) { b[1] = 81; }),
      "file: byte 1: found 81, expected 80, the mark of a C3D file; this is another format or "
      "damaged");
  EXPECT_EQ(broken([](std::string& b) { b[0] = 99; }),
            "file: byte 0: the parameter section is said to start at block 99, which the file of " +
                std::to_string(good.size()) + " bytes does not hold");
  EXPECT_EQ(broken([](std::string& b) { b[512 + 3] = 87; }),
            "file: byte 515: processor type 87; expected 84 (Intel), 85 (DEC) or 86 (MIPS)");
  EXPECT_EQ(broken([](std::string& b) { b.resize(b.size() - 512); }),
            "file: byte " + std::to_string(good.size() - 512) +
                ": TRIAL:ACTUAL_END_FIELD promises 40 frames of 80 bytes, the file holds 38; it is "
                "cut off or its counts are wrong (--accept-truncated reads what is there)");
  // A chain cannot go back: a distance into the record's own data is refused.
  ExpectHolds(broken([](std::string& b) { SetWord(b, FindParameter(b, "SCALE") - 4, 1); }),
              "record SCALE points to byte");
  ExpectHolds(broken([](std::string& b) { b[FindParameter(b, "SCALE") - 2] = 7; }),
              "parameter SCALE has type 7; expected -1 (text), 1, 2 or 4");
  ExpectHolds(broken([](std::string& b) {
                const size_t at = FindParameter(b, "LABELS");
                b[at - 1] = b[at - 2] = '\xff';
              }),
              "a parameter record runs past the end of the parameter section");
  ExpectHolds(broken([](std::string& b) {
                SetWord(b, 16, 9999);
                SetWord(b, FindParameter(b, "DATA_START"), 9998);
              }),
              "byte 16: the data are said to start at block 9999");
  ExpectHolds(broken([](std::string& b) {
                SetFloat(b, 12, 0.0f);
                SetFloat(b, FindParameter(b, "SCALE"), 0.0f);
              }),
              "neither POINT:SCALE nor the header gives a scale factor");
}

// Two MIPS files of the collection on c3d.org store the pointer of their last parameter so.
TEST(C3dImporter, AnUnswappedOrWildPointerToTheNextRecordIsNotedAndNotFollowed) {
  const Recording made = MakeSyntheticRecording(40, 3);
  for (const C3dProcessor processor : kProcessors) {
    C3dWriteOptions options;
    options.processor = processor;
    const std::string good = FormatC3d(made, options);
    const Recording expected = ImportBytes(good, "c3d");
    for (const char* name : {"RATE", "ACTUAL_END_FIELD"}) {
      const size_t pointer = FindName(good, name) + std::string(name).size();
      std::string swapped = good, wild = good;
      std::swap(swapped[pointer], swapped[pointer + 1]);
      wild[pointer] = wild[pointer + 1] = '\xff';
      for (const std::string& bytes : {swapped, wild}) {
        const Recording found = ImportBytes(bytes, "c3d");
        EXPECT_EQ(CountFindings(found, "parameter_pointer"), 1u) << name;
        ASSERT_EQ(found.points.size(), expected.points.size());
        EXPECT_EQ(found.num_frames, expected.num_frames);
        EXPECT_EQ(found.rate, expected.rate);
        EXPECT_EQ(found.points[1].xyz, expected.points[1].xyz);
      }
    }
  }
}

TEST(C3dImporter, LyingCountsDoNotAllocate) {
  std::string bytes = FormatC3d(MakeSyntheticRecording(40, 3));
  SetWord(bytes, 2, 65535);
  SetWord(bytes, 4, 65535);
  SetWord(bytes, FindParameter(bytes, "USED"), 65535);
  SetWord(bytes, FindParameter(bytes, "ACTUAL_END_FIELD") + 2, 32767);
  ExpectHolds(ImportFault(bytes, "c3d"), "promises");
  ImportOptions options;
  options.accept_truncated = true;
  ExpectHolds(ImportFault(bytes, "c3d", options), "the file holds 0");
}

TEST(C3dWriter, RefusesWhatTheFormatCannotHold) {
  Recording recording = MakeSyntheticRecording(4, 2);
  recording.points[1].unit = "m";
  EXPECT_THROW(FormatC3d(recording), Error);
  recording = MakeSyntheticRecording(4, 2);
  recording.times = {0, 0.1, 0.3, 0.4};
  EXPECT_THROW(FormatC3d(recording), Error);
  recording = MakeSyntheticRecording(4, 2);
  recording.analog[0].rate = 250.0;
  EXPECT_THROW(FormatC3d(recording), Error);
}

/** A group SUBJECTS with a name, put in place of the TRIAL group's end of the chain. */
std::string InsertSubject(std::string bytes, const std::string& name) {
  const size_t at = bytes.find(std::string("\x05\xff") + "POINT");
  std::string records = std::string("\x08\xf7") + "SUBJECTS" + std::string("\x03\x00\x00", 3);
  records += std::string("\x05\x09") + "NAMES";
  std::string distance;
  AppendC3dWord(distance, C3dProcessor::kIntel, static_cast<uint16_t>(2 + 3 + name.size() + 1));
  records += distance + "\xff\x01" + static_cast<char>(name.size()) + name + std::string(1, '\0');
  // The section is padded with zeros, which make room.
  const size_t data = FindData(bytes);
  bytes.insert(at, records);
  bytes.erase(data, records.size());
  return bytes;
}

TEST(C3dRedact, BlanksNamesAndTheirPrefixesAndNothingElse) {
  Recording original = MakeSyntheticRecording(6, 2);
  original.points[0].label = "Anna B:LTHUMB";
  original.points[1].label = "LINDEX";
  const std::string bytes = InsertSubject(FormatC3d(original), "Anna B");
  EXPECT_EQ(CountFindings(ImportBytes(bytes, "c3d"), "personal_data"), 1u);
  std::string redacted = bytes;
  const auto fields = FindImporter("c3d", "", "").redact(redacted, "file");
  ASSERT_EQ(fields.size(), 2u);
  EXPECT_EQ(fields[0].where, "SUBJECTS:NAMES");
  EXPECT_EQ(fields[0].text, "Anna B");
  EXPECT_EQ(redacted.find("Anna"), std::string::npos);
  EXPECT_EQ(redacted.size(), bytes.size());
  EXPECT_EQ(redacted.substr(FindData(bytes)), bytes.substr(FindData(bytes)));
  const Recording read = ImportBytes(redacted, "c3d");
  EXPECT_EQ(CountFindings(read, "personal_data"), 0u);
  EXPECT_EQ(read.points[0].label, "LTHUMB");
  EXPECT_EQ(read.points[0].xyz, original.points[0].xyz);
}

}  // namespace
}  // namespace graspbench
