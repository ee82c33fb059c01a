#include "fsw/mission/image_records.hpp"

#include <cstddef>

#include "fsw/core/byte_codec.hpp"

namespace lasso {

SensorParameters sensor_of(const ImageTable& table, std::uint32_t record) {
  SensorParameters sensor{};
  ByteReader reader(ConstBytes(table.data + std::size_t{4} * kSensorWords * record, std::size_t{4} * kSensorWords));
  for (const ParameterRow& row : sensor_rows()) sensor.*sensor_member(row) = reader.f64();
  return sensor;
}

TriangulationCalibration calibration_of(const ImageTable& table, std::uint32_t record) {
  TriangulationCalibration calibration;
  ByteReader reader(ConstBytes(table.data + std::size_t{4} * kCalibrationWords * record, std::size_t{4} * kCalibrationWords));
  static_cast<void>(reader.u32());  // the sensor's number
  calibration.serial = reader.u32();
  for (const CalibrationReal& real : kCalibrationReals) calibration.*real.member = reader.f64();
  for (double& term : calibration.residual) term = reader.f64();
  return calibration;
}

NamedFrame named_frame_of(const ImageTable& table, std::uint32_t record) {
  ByteReader reader(ConstBytes(table.data + std::size_t{4} * kNamedFrameWords * record, std::size_t{4} * kNamedFrameWords));
  NamedFrame frame;
  for (Pose* pose : {&frame.T_target_of, &frame.T_in_sensor}) {
    for (double& term : pose->q.coeffs().reshaped()) term = reader.f64();
    for (int i = 0; i < 3; ++i) pose->p[i] = reader.f64();
  }
  return frame;
}

MissionParameters parameters_of(const ImageTable& table) {
  MissionParameters parameters{};
  ByteReader reader(ConstBytes(table.data, table.bytes()));
  for (const ParameterRow& row : parameter_rows()) parameters.*row.member = reader.f64();
  return parameters;
}

}  // namespace lasso
