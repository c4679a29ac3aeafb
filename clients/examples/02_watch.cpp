// Follow a job's events: every change of state comes once, progress when there is some.
//   02_watch SERVER JOB
#include <iostream>

#include "clients/cpp/client.hpp"

int main(int count, char** arguments) {
  if (count != 3) return std::cerr << "usage: 02_watch SERVER JOB\n", 2;
  sculpt::client::Client client(arguments[1], "02_watch");
  client.when_lost([](const std::string& sentence) { std::cerr << sentence << "\n"; });

  client.subscribe(arguments[2]);  // from the first event on, also of a job that has ended
  while (true) {
    const sculpt::Json event = *client.next_event();
    if (event.at("type") == "progress")
      std::cout << event.at("data").at("stage").get<std::string>() << " " << event.at("data").at("done") << "/"
                << event.at("data").at("total") << "\n";
    if (event.at("type") != "state") continue;
    const std::string state = event.at("data").at("to");
    std::cout << event.at("seq") << " " << state << "\n";
    if (sculpt::client::is_final(state)) return state == "succeeded" ? 0 : 1;
  }
}
