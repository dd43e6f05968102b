# Writes the text of a file into a C++ function:
#   cmake -DTEXT=docs/report.schema.json -DOUTPUT=report_schema.cpp -P schema.cmake
cmake_minimum_required(VERSION 3.25)

file(READ ${TEXT} text)
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#include "cli/report_json.h"

std::string_view asdfvk::reportSchemaText() {
  return R"SCHEMA(@text@)SCHEMA";
}
]])
