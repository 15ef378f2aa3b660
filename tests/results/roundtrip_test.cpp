// The reader returns the data that were given to the writer, from finished and unfinished files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "results/synthetic.hpp"

namespace gnomon::roundtrip_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Three stored steps at t = 0, 0.5, 1 and a history of `rows` rows.
std::unique_ptr<ResultWriter> write(const std::filesystem::path& file, const Grid& grid,
                                    int rows = 5) {
  auto writer = std::make_unique<ResultWriter>(file, synthetic::header(), grid);
  for (int i = 0; i < rows; ++i) writer->append(synthetic::row(i));
  for (const double t : {0.0, 0.5, 1.0}) {
    writer->store(t, synthetic::fields(grid, t), synthetic::contact(t));
  }
  return writer;
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

TEST(ResultFile, ReturnsTheHeaderAndHowTheRunEnded) {
  const auto file = synthetic::folder("header") / "r.h5";
  write(file, synthetic::grid(4, 3))->close("failed: element 7 is inverted", 12.5);
  const ResultReader reader(file);
  const RunHeader expected = synthetic::header();
  EXPECT_EQ(reader.header().problem, expected.problem);
  EXPECT_EQ(reader.header().integrator, expected.integrator);
  EXPECT_EQ(reader.header().scene, expected.scene);
  EXPECT_EQ(reader.header().versions, expected.versions);
  ASSERT_EQ(reader.header().blocks.size(), 2u);
  EXPECT_EQ(reader.header().blocks[1].name, "shape");
  EXPECT_EQ(reader.header().blocks[1].symbol, "d");
  EXPECT_EQ(reader.header().blocks[1].size, 38);
  EXPECT_EQ(reader.header().blocks[1].where, "near the contact");
  EXPECT_EQ(reader.status(), "failed: element 7 is inverted");
  EXPECT_EQ(reader.wall_seconds(), 12.5);
}

TEST(ResultFile, ReturnsEveryCellOfALongHistory) {
  const auto file = synthetic::folder("history") / "r.h5";
  const int rows = 600;  // more than two chunks
  write(file, synthetic::grid(4, 3), rows)->close("finished", 1);
  const auto history = ResultReader(file).history();
  ASSERT_EQ(history.size(), static_cast<std::size_t>(rows));
  for (int i = 0; i < rows; ++i) {
    const HistoryRow expected = synthetic::row(i);
    const HistoryRow& row = history[static_cast<std::size_t>(i)];
    EXPECT_EQ(row.t, expected.t);
    EXPECT_EQ(row.step.step, expected.step.step);
    EXPECT_EQ(row.step.order, expected.step.order);
    EXPECT_EQ(row.step.newton_iterations, expected.step.newton_iterations);
    EXPECT_EQ(row.step.restarted, expected.step.restarted);
    EXPECT_EQ(row.step.switched, expected.step.switched);
    EXPECT_EQ(row.counters.steps, expected.counters.steps);
    EXPECT_EQ(row.counters.rejected_steps, expected.counters.rejected_steps);
    EXPECT_EQ(row.counters.events, expected.counters.events);
    EXPECT_EQ(row.counters.newton_iterations, expected.counters.newton_iterations);
    EXPECT_EQ(row.counters.residual_evaluations, expected.counters.residual_evaluations);
    EXPECT_EQ(row.counters.jacobian_evaluations, expected.counters.jacobian_evaluations);
    EXPECT_EQ(row.counters.factorizations, expected.counters.factorizations);
    EXPECT_EQ(row.counters.linear_solves, expected.counters.linear_solves);
    ASSERT_EQ(row.scalars.size(), 2u);
    EXPECT_EQ(row.scalars[0].name, "worn_volume");
    EXPECT_EQ(row.scalars[0].unit, "mm^2");
    EXPECT_EQ(row.scalars[0].value, 0.5 * i);
    EXPECT_EQ(row.scalars[1].name, "contact_force");
  }
}

TEST(ResultFile, ReturnsMeshAndFields) {
  for (const Grid& grid : {synthetic::grid(4, 3), synthetic::hexahedra()}) {
    const auto file = synthetic::folder("fields") / "r.h5";
    write(file, grid)->close("finished", 1);
    const ResultReader reader(file);
    ASSERT_TRUE(reader.grid());
    EXPECT_EQ(reader.grid()->cell, grid.cell);
    EXPECT_EQ(reader.grid()->points, grid.points);
    EXPECT_EQ(reader.grid()->cells, grid.cells);
    EXPECT_THAT(reader.stored_times(), ElementsAre(0, 0.5, 1));
    EXPECT_THAT(reader.field_names(), ElementsAre("displacement", "element_quality",
                                                  "equivalent_stress", "pressure", "shape"));
    for (const GridField& expected : synthetic::fields(grid, 0.5)) {
      const GridField field = reader.field(1, expected.name);
      EXPECT_EQ(field.unit, expected.unit);
      EXPECT_EQ(field.on, expected.on);
      EXPECT_EQ(field.components, expected.components);
      EXPECT_EQ(field.values, expected.values);
    }
    EXPECT_THAT([&] { reader.field(3, "shape"); },
                ThrowsMessage<InputError>(HasSubstr("it has 3 stored steps, not 4")));
    EXPECT_THAT([&] { reader.field(1, "temperature"); },
                ThrowsMessage<InputError>(HasSubstr("it has no field temperature")));
  }
}

TEST(ResultFile, FindsTheContactSurfaceAtATime) {
  const auto file = synthetic::folder("contact") / "r.h5";
  write(file, synthetic::grid(4, 3))->close("finished", 1);
  const ResultReader reader(file);
  const ContactSurface expected = synthetic::contact(0.5);
  const ContactSurface contact = reader.contact(0.5 + 5e-10);
  EXPECT_EQ(contact.dim, 2);
  EXPECT_EQ(contact.node, expected.node);
  EXPECT_EQ(contact.initial, expected.initial);
  EXPECT_EQ(contact.worn, expected.worn);
  EXPECT_EQ(contact.current, expected.current);
  EXPECT_EQ(contact.pressure, expected.pressure);
  EXPECT_EQ(contact.wear_depth, expected.wear_depth);
  EXPECT_EQ(contact.active, expected.active);
  EXPECT_EQ(contact.phase_position, expected.phase_position);
  EXPECT_EQ(contact.phase_weight, expected.phase_weight);
  EXPECT_EQ(contact.phase_pressure, expected.phase_pressure);
  EXPECT_EQ(contact.phase_traction, expected.phase_traction);
  EXPECT_EQ(contact.phase_slip, expected.phase_slip);
  EXPECT_EQ(contact.phase_loop, expected.phase_loop);
  EXPECT_EQ(reader.contact({}).wear_depth.front(), 1);
  EXPECT_EQ(reader.contact(0.500004).wear_depth.front(), 0.5);  // as printed with six digits
  EXPECT_THROW(reader.contact(0.50001), InputError);
  EXPECT_THROW(reader.contact(NAN), InputError);
  EXPECT_THAT([&] { reader.contact(0.6); },
              ThrowsMessage<InputError>(HasSubstr("t = 0.6; next to it are t = 0.5 and 1")));
  EXPECT_THAT([&] { reader.contact(2); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("t = 2; next to it are t = 1"))));
}

TEST(ResultFile, ReturnsTheErrorsOfTheMeanOverPhases) {
  const auto folder = synthetic::folder("phases");
  {
    ResultWriter writer(folder / "r.h5", synthetic::header(), std::nullopt);
    writer.append(synthetic::row(0));
    writer.append_phase_error(PhaseError{0, 16, 0.25});
    EXPECT_EQ(ResultReader(folder / "r.h5").phase_errors().size(), 1u);
    writer.append_phase_error(PhaseError{40, 16, 1e-3});
    writer.close("finished", 1);
  }
  const ResultReader reader(folder / "r.h5");
  const std::vector<PhaseError> errors = reader.phase_errors();
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_EQ(errors[1].t, 40);
  EXPECT_EQ(errors[1].phases, 16);
  EXPECT_EQ(errors[1].error, 1e-3);
  ASSERT_EQ(start_errors(reader).size(), 1u);
  EXPECT_EQ(start_errors(reader).front().error, 0.25);
  write(folder / "steady.h5", synthetic::grid(4, 3))->close("finished", 1);
  EXPECT_TRUE(ResultReader(folder / "steady.h5").phase_errors().empty());
}

// Points and facets that have not changed are those of an earlier step.
TEST(ResultFile, ReturnsTheCounterBodyAndStoresNothingTwice) {
  const auto folder = synthetic::folder("counter");
  const Grid grid = synthetic::grid(4, 3);
  const auto store = [&](const std::string& name, const std::vector<double>& places) {
    ResultWriter writer(folder / name, synthetic::header(), grid);
    writer.append(synthetic::row(0));
    for (std::size_t step = 0; step < places.size(); ++step)
      writer.store(double(step), {}, {}, synthetic::counter_body(places[step]));
    writer.store(9, {}, {}, CounterSurface{});
    writer.store(10, {}, {});
    writer.close("finished", 1);
    return std::filesystem::file_size(folder / name);
  };
  const std::vector<double> places = {0, 0.5, 1, 1, 0};
  store("moves.h5", places);
  const ResultReader reader(folder / "moves.h5");
  for (std::size_t step = 0; step < places.size(); ++step) {
    const CounterSurface expected = synthetic::counter_body(places[step]);
    const auto surface = reader.counter_surface(step);
    ASSERT_TRUE(surface) << step;
    EXPECT_EQ(surface->dim, 2);
    EXPECT_EQ(surface->points, expected.points) << step;
    EXPECT_EQ(surface->facets, expected.facets) << step;
  }
  EXPECT_FALSE(reader.counter_surface(5));
  EXPECT_FALSE(reader.counter_surface(6));
  EXPECT_LT(store("rests.h5", {0, 0, 0, 0, 0}), store("other.h5", {0, 1, 0, 1, 0}));
}

TEST(ResultFile, IsReadableWhileItIsWritten) {
  const auto file = synthetic::folder("running") / "r.h5";
  const Grid grid = synthetic::grid(4, 3);
  ResultWriter writer(file, synthetic::header(), grid);
  for (int i = 0; i < 250; ++i) {  // more than two groups of stored steps
    writer.append(synthetic::row(i));
    writer.store(i, synthetic::fields(grid, i), synthetic::contact(i));
    if (i % 25 != 0) continue;
    const ResultReader reader(file);
    EXPECT_EQ(reader.history().size(), static_cast<std::size_t>(i) + 1);
    EXPECT_EQ(reader.stored_times().back(), i);
    EXPECT_EQ(reader.contact({}).wear_depth.front(), i);
    EXPECT_EQ(reader.field(static_cast<std::size_t>(i), "displacement").values.front(), i);
    EXPECT_EQ(reader.status(), "running or crashed");
    EXPECT_EQ(reader.wall_seconds(), 0);
  }
}

TEST(ResultFile, NeedsNeitherMeshNorContactNorSteps) {
  const auto file = synthetic::folder("scalar") / "r.h5";
  std::ofstream(std::filesystem::path(file).replace_extension(".xdmf")) << "of an earlier run";
  EXPECT_TRUE(is_taken(sidecar_of(file)));
  ResultWriter(file, synthetic::header(), std::nullopt, Earlier::replaced).append(HistoryRow{});
  EXPECT_FALSE(is_taken(sidecar_of(file)));
  std::filesystem::remove(file);
  ResultWriter writer(file, synthetic::header(), std::nullopt);
  EXPECT_THAT(ResultReader(file).history(), testing::IsEmpty());
  EXPECT_THAT(ResultReader(file).stored_times(), testing::IsEmpty());
  EXPECT_THAT(ResultReader(file).field_names(), testing::IsEmpty());
  EXPECT_FALSE(ResultReader(file).grid());
  EXPECT_THAT([&] { ResultReader(file).contact({}); },
              ThrowsMessage<InputError>(HasSubstr("it has no stored step")));
  writer.store(0, {}, std::nullopt);
  EXPECT_THAT([&] { ResultReader(file).contact({}); },
              ThrowsMessage<InputError>(HasSubstr("no contact surface")));
}

// Zeros take no space, and what is compressed comes back to the last digit.
TEST(ResultFile, IsCompressedAndComesBackExactly) {
  const auto file = synthetic::folder("compressed") / "r.h5";
  const Grid grid = synthetic::grid(300, 200);
  std::vector<GridField> fields = synthetic::fields(grid, 0.5);
  std::size_t bytes = std::size_t{24} * grid.points.size() + std::size_t{4} * grid.cells.size();
  for (const GridField& field : fields) bytes += 8 * field.values.size();
  for (double& value : fields[1].values) value = std::sin(1e3 * value);
  ResultWriter writer(file, synthetic::header(), grid);
  writer.append(synthetic::row(0));
  writer.store(0, fields, synthetic::contact(0));
  writer.close("finished", 1);
  EXPECT_LT(std::filesystem::file_size(file), bytes / 2);
  const ResultReader reader(file);
  EXPECT_EQ(reader.grid()->points, grid.points);
  EXPECT_EQ(reader.grid()->cells, grid.cells);
  for (const GridField& field : fields)
    EXPECT_TRUE(reader.field(0, field.name).values == field.values) << field.name;
}

TEST(ResultFile, HasTheSameBytesForTheSameRun) {
  const auto folder = synthetic::folder("bytes");
  write(folder / "a.h5", synthetic::grid(4, 3))->close("finished", 1);
  write(folder / "b.h5", synthetic::grid(4, 3))->close("finished", 1);
  EXPECT_TRUE(text_of(folder / "a.h5") == text_of(folder / "b.h5"));
}

TEST(ResultFile, RefusesDataThatDoNotFit) {
  const auto folder = synthetic::folder("misfit");
  const Grid grid = synthetic::grid(4, 3);
  auto fields = synthetic::fields(grid, 0);
  fields[2].values.pop_back();
  EXPECT_THAT([&] { write(folder / "a.h5", grid)->store(2, fields, {}); },
              ThrowsMessage<Error>(HasSubstr("field pressure has 19 values for 20 places")));
  auto row = synthetic::row(6);
  row.scalars.pop_back();
  EXPECT_THAT([&] { write(folder / "b.h5", grid)->append(row); },
              ThrowsMessage<Error>(HasSubstr("scalars of a history row")));
  EXPECT_EQ(ResultReader(folder / "a.h5").stored_times().size(), 3u);
}

}  // namespace
}  // namespace gnomon::roundtrip_test
