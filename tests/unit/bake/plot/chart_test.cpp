#include "assets/bake/plot/chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "assets/bake/plot/error_plot.h"
#include "assets/bake/plot/metrics_plot.h"

namespace caryatid::bake {
namespace {

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

TEST(Chart, TicksAreRoundAndInside) {
  EXPECT_EQ(ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(ticks(3, 22, 4), (std::vector<double>{5, 10, 15, 20}));
  EXPECT_EQ(ticks(-1, 1, 2), (std::vector<double>{-1, 0, 1}));
  EXPECT_TRUE(ticks(1, 1, 5).empty());
}

TEST(Chart, LogarithmicTicksGoByOneTwoFive) {
  const std::vector<double> t = log_ticks(3, 50);
  ASSERT_EQ(t.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(t[i], (std::vector{5.0, 10.0, 20.0, 50.0})[i], 1e-9);
}

TEST(Chart, ALongLineStaysSmallAndKeepsItsSpike) {
  ChartPanel panel;
  ChartLine line{"a", "#000000", {}, false, 1.0};
  for (int i = 0; i < 200000; ++i) {
    panel.x.push_back(i);
    line.y.push_back(i == 123456 ? 100.0 : 1.0 + i % 2);
  }
  panel.lines.push_back(line);
  panel.low = 0;
  panel.high = 100;
  const std::string svg = chart_svg({"t", "x", {panel}, 960});
  EXPECT_LT(svg.size(), 100000u);
  EXPECT_NE(svg.find(" 68.0"), std::string::npos);  // The spike reaches the panel's top.
}

TEST(Chart, NotANumberBreaksTheLine) {
  ChartPanel panel;
  panel.x = {0, 1, 2, 3};
  panel.lines.push_back(
      {"", "#000000", {1, std::numeric_limits<double>::quiet_NaN(), 1, 2}, false, 1.0});
  EXPECT_EQ(count_of(chart_svg({"", "", {panel}, 960}), " M"), 2u);
}

TEST(Chart, NamesAreEscaped) {
  ChartPanel panel;
  panel.x = {0, 1};
  panel.lines.push_back({"<a&b>", "#000000", {0, 1}, false, 1.0});
  EXPECT_NE(chart_svg({"", "", {panel}, 960}).find("&lt;a&amp;b>"), std::string::npos);
}

constexpr const char* kRun =
    "{\"time_s\":0.0,\"cpu_ms\":3.5,\"gpu_ms\":null,\"late\":false,\"triangles\":900,"
    "\"lod\":{\"head\":600,\"body\":300},\"render_scale\":1.0}\n"
    "{\"time_s\":0.033,\"cpu_ms\":4.5,\"gpu_ms\":40.0,\"late\":true,\"triangles\":800,"
    "\"lod\":{\"head\":500,\"body\":300},\"render_scale\":0.75}\n";

TEST(Metrics, AreReadAsWritten) {
  const MetricsRun run = parse_metrics(kRun, "dir/day.jsonl");
  EXPECT_EQ(run.name, "day");
  EXPECT_EQ(run.time_s, (std::vector<double>{0.0, 0.033}));
  EXPECT_EQ(run.triangles, (std::vector<double>{900, 800}));
  EXPECT_TRUE(std::isnan(run.gpu_ms[0]));
  EXPECT_EQ(run.late, (std::vector<bool>{false, true}));
  ASSERT_EQ(run.objects.size(), 2u);
  EXPECT_EQ(run.objects[1].first, "head");
  EXPECT_EQ(run.objects[1].second, (std::vector<double>{600, 500}));
}

TEST(Metrics, LateFramesAreMarkedAtTheirCost) {
  const Chart chart = metrics_chart({parse_metrics(kRun, "day.jsonl")});
  ASSERT_EQ(chart.panels[0].marks.size(), 1u);
  EXPECT_DOUBLE_EQ(chart.panels[0].marks[0].second, 44.5);
  EXPECT_NE(chart_svg(chart).find("late (1)"), std::string::npos);
}

TEST(Metrics, BadFilesAreRefusedByLine) {
  const auto what = [](const std::string& text) {
    try {
      parse_metrics(text, "m");
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(what("").substr(0, 14), "m:1: no frames");
  EXPECT_EQ(what(std::string(kRun) + "nonsense\n").substr(0, 9), "m:3: not ");
  EXPECT_EQ(what("{\"time_s\":1}\n").substr(0, 5), "m:1: ");
  EXPECT_EQ(what(std::string(kRun) + "{\"time_s\":0,\"triangles\":1}").substr(0, 16),
            "m:3: time_s goes");
}

TEST(ErrorPlot, APanelAMeshALineAMethod) {
  const std::string run =
      R"({"name":"simplify/ball/ours/50/iterations:3","mean":1e-4,"hausdorff":1e-3})";
  std::string peer = run;
  peer.replace(peer.find("ours"), 4, "peer");
  const Chart chart = error_chart(R"({"benchmarks":[)" + run + "," + peer + "]}", "f");
  ASSERT_EQ(chart.panels.size(), 1u);
  EXPECT_EQ(chart.panels[0].title, "ball");
  EXPECT_EQ(chart.panels[0].x, std::vector<double>{50});
  ASSERT_EQ(chart.panels[0].lines.size(), 4u);
  EXPECT_EQ(chart.panels[0].lines[2].name, "peer");
  EXPECT_EQ(chart.panels[0].lines[1].y, std::vector<double>{1e-3});
  EXPECT_THROW((void)error_chart("{}", "f"), std::runtime_error);
  EXPECT_THROW((void)error_chart("", "f"), std::runtime_error);
}

TEST(FapPlot, ShowsWhatMoves) {
  std::string text = "2.1 test 10 2\n";
  for (int frame = 0; frame < 2; ++frame) {
    for (int fap = 1; fap <= 68; ++fap) text += fap == 3 ? "1 " : "0 ";
    text += "\n" + std::to_string(frame) + " " + std::to_string(300 * frame) + "\n";
  }
  const Chart chart = fap_chart(text, "open.fap");
  ASSERT_EQ(chart.panels.size(), 1u);
  EXPECT_EQ(chart.panels[0].lines[0].name, "3 open_jaw");
  EXPECT_EQ(chart.panels[0].lines[0].y, (std::vector<double>{0, 300}));
  EXPECT_DOUBLE_EQ(chart.panels[0].x[1], 0.1);
  EXPECT_THROW(fap_chart("", "none.fap"), std::runtime_error);
}

}  // namespace
}  // namespace caryatid::bake
