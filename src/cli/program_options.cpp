#include "cli/program_options.h"

#include "batch/check_report.h"
#include "cli/program_values.h"
#include "core/text.h"
#include "describe/computation_options.h"

namespace asdfvk {
namespace {

constexpr const char* kPictureGroup = "Picture";
constexpr const char* kBatchGroup = "Many meshes";
constexpr double kMaxSeconds = 1e9, kMaxJobCount = 1024;

std::vector<std::string> pictureFields() {
  std::vector<std::string> names = resultFieldNames();
  std::erase(names, "centre");
  return names;
}

const std::string kFieldsText =
    "Fields to write: " + joined(resultFieldNames(), ", ") + ". A page has all fields of one component by default";

}  // namespace

OptionRows outputRows(Outputs& outputs) {
  return withGroups({
      OptionRow{.name = "output",
                .group = kOutputGroup,
                .member = memberAs<NameCodec>(&outputs.path),
                .text = "Result: a file, a directory, or - for standard output. FILE.html is a page that shows the "
                        "results of all meshes in a browser",
                .more = "[page.md](page.md) and [formats.md](formats.md) describe the formats.",
                .placeholder = "FILE|DIR|-",
                .defaultText = "NAME.asdf.ply beside the input; none with {fail-if-thinner}",
                .flags = "-o,--output"},
      OptionRow{.name = "fields",
                .member = memberAs<FieldListCodec>(&outputs.fields),
                .text = kFieldsText.c_str(),
                .more = "The first real field is the `quality` of `.ply`. `.npy` has the first field only "
                        "([formats.md](formats.md)).",
                .placeholder = "NAME,...",
                .defaultText = "sdf,seed, and the fields of {measure}, {postprocess} and {segment}",
                .names = resultFieldNames},
      OptionRow{.name = "open",
                .member = &outputs.opensPage,
                .text = "Open the page in the browser. Without -o the page is NAME.asdf.html"},
      OptionRow{
          .name = "json", .member = &outputs.json, .text = "Report as JSON on standard output, one line per mesh"},
      OptionRow{.name = "report-format",
                .member = &outputs.reportFormat,
                .text = "Also report the checks of all meshes for continuous integration. sarif: SARIF 2.1.0. junit: "
                        "a test case per mesh. github: an annotation per place",
                .more = "[integration.md](integration.md) has examples.",
                .names = checkFormatNames},
      OptionRow{.name = "report",
                .member = memberAs<NameCodec>(&outputs.report),
                .text = "File of the report of checks; - is standard output",
                .placeholder = "FILE|-",
                .needs = "report-format"},
      OptionRow{.name = "limits",
                .member = memberAs<NameCodec>(&outputs.limits),
                .text = "Limits of single meshes: a JSON file of rules, each with a pattern of files and its limits. "
                        "Without -o, no result is written",
                .more = "[integration.md](integration.md#limits) describes the file.",
                .placeholder = "FILE.json"},
      OptionRow{.name = "baseline",
                .member = memberAs<NameCodec>(&outputs.baseline),
                .text = "Known places, which do not fail the check: a JSON file that {update-baseline} writes",
                .placeholder = "FILE.json"},
      OptionRow{.name = "update-baseline",
                .member = &outputs.updatesBaseline,
                .text =
                    "Write the places that fail the check to the file of {baseline}; they do not determine the exit "
                    "code",
                .needs = "baseline"},
      OptionRow{.name = "format",
                .member = &outputs.format,
                .text = "Format of the result if the name of -o does not determine the format",
                .defaultText = "ply",
                .names = outputFormats},
      OptionRow{.name = "ascii", .member = &outputs.ascii, .text = "Write PLY as text"},
      OptionRow{.name = "colour-of",
                .member = memberAs<FieldCodec>(&outputs.colourOf),
                .text = "Field that determines the colours in .ply, .glb and .obj",
                .more = "The field must be written and have one component.",
                .defaultText = "segment with {segment}, else the first real field",
                .names = pictureFields},
      OptionRow{.name = "vertex-colours",
                .member = &outputs.coloursVertices,
                .text = "Also colour the vertices of PLY; Blender shows vertex colours",
                .more = "`.glb` and `.obj` always have vertex colours."},
      OptionRow{.name = "points",
                .member = memberAs<FileCodec>(&outputs.points),
                .text = "Also write a skeleton point for each face, half of the shape diameter below the face. PLY: "
                        "points with radius and segment. SWC: points with radius, joined into trees. - is PLY on "
                        "standard output. For one mesh only",
                .placeholder = "FILE.ply|FILE.swc",
                .wanted = "a file that ends in .ply or .swc"},
      OptionRow{.name = "quiet", .member = &outputs.quiet, .text = "Print errors only"},
      OptionRow{.name = "verbose",
                .member = &outputs.verbose,
                .text = "Print the full report: device, seeds, times, solver, places. Implies {next-wall}"},
      OptionRow{
          .name = "picture",
          .group = kPictureGroup,
          .member = memberAs<FileCodec>(&outputs.picture),
          .text = "Also render the coloured mesh; - is standard output. FOLDER/ is for many meshes: a picture "
                  "NAME.asdf.png of each mesh that fails the check, or of each mesh if there is no check",
          .more = "The picture has 1200 x 900 pixels, in a folder 480 x 360, and a colour bar from the 1st to the 99th "
                  "percentile "
                  "([batches.md](batches.md#pictures)).",
          .placeholder = "FILE.png|FOLDER/",
          .wanted = "a file that ends in .png, or a folder that ends in /"},
      OptionRow{.name = "picture-of",
                .member = memberAs<ShownFieldCodec>(&outputs.pictureOf),
                .text = "Field that the picture shows",
                .needs = "picture",
                .defaultText =
                    "sdf, segment with {segment}, thickness with {measure=thickness}, or the places thinner than "
                    "a limit",
                .names = pictureFields},
      OptionRow{.name = "picture-view",
                .member = memberAs<ViewCodec>(&outputs),
                .text = "Direction of the view: azimuth in degrees to the right of the broad side of the mesh (-360 to "
                        "360), and elevation (-90 to 90)",
                .placeholder = "AZIMUTH,ELEVATION",
                .needs = "picture",
                .defaultText = "30,18 (for thin places the view that shows them best)"},
      OptionRow{.name = "picture-up",
                .member = memberAs<AutoChoiceCodec<kUps>>(&outputs.pictureView.up),
                .text = "Up axis of the picture. auto: z for STL and 3MF, usually y for GLB, OBJ and OFF, and z "
                        "for other formats; another axis if only on that axis the mesh stands stably",
                .needs = "picture"},
  });
}

OptionRows batchRows(BatchOptions& batch) {
  return withGroups({
      OptionRow{.name = "recursive",
                .group = kBatchGroup,
                .member = &batch.recurses,
                .text = "Compute every mesh below the given folders. The results have the same subfolders below -o",
                .flags = "-r,--recursive"},
      OptionRow{.name = "files-from",
                .member = &batch.list,
                .text = "Also compute the meshes of a list; - is standard input. A line has a path, or a path, a tab "
                        "and a key, which "
                        "names the results of this mesh",
                .placeholder = "FILE|-"},
      OptionRow{.name = "null",
                .member = &batch.isNullSeparated,
                .text = "Paths of the list end with a zero byte, as find -print0 writes them, and have no keys",
                .needs = "files-from",
                .flags = "-0,--null"},
      OptionRow{
          .name = "tar",
          .member = &batch.readsTars,
          .text =
              "The inputs are tars of meshes, also compressed. The answers are tars: a result and a record per mesh, "
              "in the order of the meshes; only records with {fail-if-thinner}",
          .more = "[batches.md](batches.md#tars) describes the tars."},
      OptionRow{.name = "keep-members",
                .member = &batch.keepsMembers,
                .text = "Also copy all members of the inputs. The answers are then named KEY.asdf.*",
                .needs = "tar"},
      OptionRow{.name = "shard",
                .member = memberAs<ShardCodec>(&batch.shard),
                .text = "Compute part I of N only; the parts have about the same size. auto: the variables of a "
                        "scheduler determine I and N",
                .more = "With `auto/N`, the scheduler determines I only ([cluster.md](cluster.md#schedulers)).",
                .placeholder = "I/N|auto|auto/N"},
      OptionRow{.name = "log",
                .member = &batch.log,
                .text = "Append a record per mesh as JSON; asdf-vk summarize FILE.jsonl reads the records",
                .placeholder = "FILE.jsonl"},
      OptionRow{.name = "skip-existing",
                .member = &batch.skipsExisting,
                .text = "Skip meshes that already have a result of the same input, options and version"},
      OptionRow{.name = "timeout",
                .member = &batch.timeoutSeconds,
                .range = aboveUpTo(0, kMaxSeconds),
                .unit = OptionUnit::Seconds,
                .text =
                    "Fail a mesh that takes longer than this, with exit code 8. Without {isolate} the limit applies "
                    "between steps only",
                .defaultText = "-"},
      OptionRow{
          .name = "memory-limit",
          .member = memberAs<MemoryCodec>(&batch.memoryBytes),
          .text =
              "Fail a mesh that takes more memory than this, such as 500M or 2G, with exit code 8; implies {isolate}",
          .placeholder = "SIZE"},
      OptionRow{.name = "isolate",
                .member = &batch.isolates,
                .text = "Compute in worker processes: if a mesh crashes or hangs, only this mesh fails"},
      OptionRow{.name = "jobs",
                .member = &batch.jobCount,
                .range = fromTo(1, kMaxJobCount),
                .text = "Number of meshes that are computed at once",
                .placeholder = "N",
                .defaultText = "the number of cores for many small meshes, else 1"},
  });
}

}  // namespace asdfvk
