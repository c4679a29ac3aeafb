// Take the trajectory while it is being planned, line by line, as a cell controller would.
//   03_stream SERVER JOB
#include <iostream>
#include <sstream>

#include "clients/cpp/client.hpp"

int main(int count, char** arguments) {
  if (count != 3) return std::cerr << "usage: 03_stream SERVER JOB\n", 2;
  sculpt::client::Client client(arguments[1], "03_stream");

  std::stringstream lines;
  int cuts = 0, moves = 0;
  bool whole = false;
  const auto take = [&] {
    std::string line;
    for (auto start = lines.tellg(); std::getline(lines, line); start = lines.tellg()) {
      if (lines.eof()) {  // half a line: the rest comes with the next piece
        lines.clear();
        lines.seekg(start);
        break;
      }
      const sculpt::Json keyframe = sculpt::Json::parse(line);
      cuts += keyframe.at("type") == "cut";
      moves += keyframe.at("type") == "move";
      whole = whole || keyframe.at("type") == "end";
    }
    lines.clear();
    return true;
  };
  client.read_artifact({arguments[2], "trajectory", "ndjson"}, lines, take);
  take();
  std::cout << cuts << " cuts, " << moves << " moves, " << (whole ? "whole" : "not whole") << "\n";
  return whole ? 0 : 1;
}
