// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
// Random numbers are drawn one per statement or in braces: the order of a call's arguments is the
// compiler's choice, and a seed must mean the same picture everywhere.
#include "sim/paintings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

namespace mvo::sim {
namespace {

// Smooth noise of several octaves, from cells of `cell` down to 4 texels, around a mean; 8UC1.
cv::Mat clouds(cv::Size size, double mean, double amplitude, int cell, Random& random) {
  constexpr int kFinest = 4;  // nothing is smaller, so the sum can be made at this scale
  const auto cells = [&](int side) {
    return cv::Size(std::max(2, size.width / side), std::max(2, size.height / side));
  };
  cv::Mat sum(cells(kFinest), CV_32FC1, cv::Scalar(mean));
  for (int side = cell; side >= kFinest; side /= 2) {
    cv::Mat octave(cells(side), CV_32FC1);
    for (float& value : cv::Mat_<float>(octave)) {
      value = static_cast<float>(random.uniform(-amplitude, amplitude));
    }
    cv::resize(octave, octave, sum.size(), 0, 0, cv::INTER_LINEAR);
    sum += octave;
    amplitude *= 0.6;
  }
  cv::Mat bytes;
  sum.convertTo(bytes, CV_8U);
  cv::resize(bytes, bytes, size, 0, 0, cv::INTER_LINEAR);
  return bytes;
}

double tone(const Tones& tones, Random& random) { return random.uniform(tones.low, tones.high); }

cv::Point anywhere(cv::Size size, Random& random) {
  return {random.integer(0, size.width - 1), random.integer(0, size.height - 1)};
}

// A convex polygon of 3 or 4 corners about a point; stretched, so that its corners differ.
std::vector<cv::Point> shard(cv::Point center, double radius, Random& random) {
  const int corners = random.integer(3, 4);
  const double turn = random.uniform(0, 2 * CV_PI);
  const double stretch = random.uniform(0.5, 1.0);
  std::vector<cv::Point> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * CV_PI * (i + random.uniform(-0.15, 0.15)) / corners;
    const double x = radius * std::cos(angle);
    const double y = stretch * radius * std::sin(angle);
    points.emplace_back(cvRound(center.x + x * std::cos(turn) - y * std::sin(turn)),
                        cvRound(center.y + x * std::sin(turn) + y * std::cos(turn)));
  }
  return points;
}

void paintGlyphs(cv::Mat& image, double height, double grey, Random& random) {
  std::string text;
  for (int i = random.integer(1, 4); i > 0; --i) {
    text += static_cast<char>(random.integer('A', 'Z'));
  }
  const int thickness = std::max(1, cvRound(height * random.uniform(0.1, 0.22)));
  cv::putText(image, text, anywhere(image.size(), random), cv::FONT_HERSHEY_DUPLEX, height / 22.0,
              cv::Scalar(grey), thickness, cv::LINE_AA);
}

void paintShape(cv::Mat& image, double radius, double grey, Random& random) {
  const cv::Point center = anywhere(image.size(), random);
  const cv::Scalar color(grey);
  switch (random.integer(0, 6)) {
    case 0:
      cv::ellipse(image, center, cv::Size(cvRound(radius), cvRound(radius * 0.7)),
                  random.uniform(0, 180), 0, 360, color, cv::FILLED, cv::LINE_AA);
      break;
    case 1:
      cv::circle(image, center, cvRound(radius * 0.8), color, std::max(1, cvRound(radius * 0.25)),
                 cv::LINE_AA);
      break;
    case 2:
      paintGlyphs(image, radius, grey, random);
      break;
    default:
      cv::fillConvexPoly(image, shard(center, radius, random), color, cv::LINE_AA);
      break;
  }
}

// Shapes whose radius shrinks from `largest` to `smallest`; the largest cover about `coverage` of
// the image, smaller ones less, so that they decorate but do not hide what is below.
void paintShapes(cv::Mat& image, double largest, double smallest, double coverage,
                 const Tones& tones, Random& random) {
  double radius = largest;
  while (radius >= smallest) {
    const int count = cvCeil(coverage * static_cast<double>(image.total()) / (3 * radius * radius));
    for (int i = 0; i < count; ++i) {
      const double grey = tone(tones, random);
      paintShape(image, radius * random.uniform(0.75, 1.3), grey, random);
    }
    coverage *= 0.72;
    radius /= 1.7;
  }
}

void addGrain(cv::Mat& image, double amplitude, Random& random) {
  constexpr double kMean = 128;
  cv::addWeighted(image, 1, clouds(image.size(), kMean, amplitude, 16, random), 1, -kMean, image);
}

}  // namespace

cv::Mat collage(cv::Size size, const Tones& tones, Random random) {
  const double mean = (tones.low + tones.high) / 2;
  const double range = tones.high - tones.low;
  cv::Mat image = clouds(size, mean, 0.15 * range, size.width / 4, random);
  const double side = std::min(size.width, size.height);
  paintShapes(image, 0.3 * side, 0.022 * side, 0.4, tones, random);
  addGrain(image, 0.02 * range, random);
  return image;
}

cv::Mat wall(cv::Size size, int brick, int poster, Random random) {
  cv::Mat image = clouds(size, 92, 6, 64, random);
  const int course = brick / 2;
  for (int row = 0; row * course < size.height; ++row) {
    int left = -random.integer(0, brick);
    while (left < size.width) {
      const int width = random.integer(brick * 2 / 3, brick * 4 / 3);
      const cv::Rect rect(left + 2, row * course + 2, width - 4, course - 4);
      cv::rectangle(image, rect, cv::Scalar(random.uniform(105, 150)), cv::FILLED);
      left += width;
    }
  }
  addGrain(image, 9, random);
  const int posters = static_cast<int>(0.45 * static_cast<double>(size.area()) / poster / poster);
  for (int i = 0; i < posters; ++i) {
    const cv::Size poster_size{cvRound(poster * random.uniform(0.5, 1.3)),
                               cvRound(poster * random.uniform(0.5, 1.3))};
    const cv::Rect rect(anywhere(size - poster_size, random), poster_size);
    const double low = random.uniform(30, 70);
    const Tones tones{low, low + random.uniform(90, 140)};
    collage(poster_size, tones, Random(random.next())).copyTo(image(rect));
    cv::rectangle(image, rect, cv::Scalar(random.uniform(40, 80)), 3);
  }
  return image;
}

cv::Mat ground(cv::Size size, int pebble, int mats, Random random) {
  cv::Mat image = clouds(size, 105, 14, 128, random);
  double radius = pebble;
  while (radius >= 4) {
    const int count = cvCeil(0.16 * static_cast<double>(size.area()) / (3 * radius * radius));
    for (int i = 0; i < count; ++i) {
      const cv::Size axes{cvRound(radius * random.uniform(0.6, 1.2)),
                          cvRound(radius * random.uniform(0.6, 1.2))};
      const cv::Point center = anywhere(size, random);
      const double turn = random.uniform(0, 180);
      cv::ellipse(image, center, axes, turn, 0, 360, cv::Scalar(random.uniform(55, 165)),
                  cv::FILLED, cv::LINE_AA);
    }
    radius /= 1.6;
  }
  for (int i = 0; i < mats; ++i) {
    const int side = size.width / 8;
    const cv::Rect rect(anywhere(size - cv::Size(side, side), random), cv::Size(side, side));
    collage(rect.size(), {40, 190}, Random(random.next())).copyTo(image(rect));
  }
  addGrain(image, 7, random);
  return image;
}

cv::Mat panels(cv::Size size, int panel, Random random) {
  cv::Mat image = clouds(size, 100, 10, 128, random);
  for (int y = 0; y < size.height; y += panel) {
    for (int x = 0; x < size.width; x += panel) {
      const cv::Rect rect(x + 3, y + 3, panel - 6, panel - 6);
      cv::rectangle(image, rect, cv::Scalar(random.uniform(80, 125)), cv::FILLED);
      if (random.integer(0, 5) == 0) {  // a ventilation grid
        for (int line = panel / 4; line < 3 * panel / 4; line += 8) {
          cv::line(image, {x + panel / 4, y + line}, {x + 3 * panel / 4, y + line}, cv::Scalar(55),
                   3);
        }
      }
    }
  }
  paintShapes(image, 0.02 * size.width, 5, 0.03, {60, 145}, random);
  addGrain(image, 6, random);
  return image;
}

cv::Mat plaster(cv::Size size, double mean, double amplitude, Random random) {
  return clouds(size, mean, amplitude, size.width / 4, random);
}

cv::Mat wood(cv::Size size, Random random) {
  cv::Mat image = clouds(size, 110, 15, size.width, random);
  for (int i = 0; i < size.area() / 600; ++i) {
    const cv::Point from = anywhere(size, random);
    const cv::Point to{from.x + random.integer(-4, 4),
                       from.y + random.integer(20, size.height / 6)};
    const double grey = random.uniform(50, 175);
    cv::line(image, from, to, cv::Scalar(grey), random.integer(1, 5), cv::LINE_AA);
  }
  paintShapes(image, 0.12 * size.width, 0.02 * size.width, 0.08, {45, 185}, random);
  addGrain(image, 8, random);
  return image;
}

cv::Mat checkerboard(cv::Size size, int columns, int rows, Random random) {
  cv::Mat image(size, CV_8UC1);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const cv::Point from(column * size.width / columns, row * size.height / rows);
      const cv::Point to((column + 1) * size.width / columns, (row + 1) * size.height / rows);
      cv::Mat square = image(cv::Rect(from, to));
      const bool dark = (row + column) % 2 == 0;
      const double mean = dark ? random.uniform(40, 60) : random.uniform(185, 210);
      clouds(square.size(), mean, 10, square.cols / 2, random).copyTo(square);
      const Tones marks = dark ? Tones{20, 150} : Tones{95, 240};
      const double side = std::min(square.cols, square.rows);
      for (int i = random.integer(3, 6); i > 0; --i) {
        const double grey = tone(marks, random);
        paintShape(square, side * random.uniform(0.05, 0.16), grey, random);
      }
    }
  }
  addGrain(image, 5, random);
  return image;
}

}  // namespace mvo::sim
