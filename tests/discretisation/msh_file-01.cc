// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// One mesh in all formats - version 2.2 and 4.1, ASCII and binary, by gmsh, and
// binary in the other byte order - must be read as the same mesh. A damaged file
// must be read or refused with an InputError, whatever is damaged, and without
// large allocations: cut at any place, with bytes changed, with numbers replaced
// by huge, negative or undefined ones.

#include <geocone/base/exceptions.h>
#include <geocone/base/parameter_file.h>
#include <geocone/mesh/msh_mesh.h>
#include <geocone/scene/scene.h>

#include <deal.II/base/mpi.h>

#include "../test.h"

#include <gmsh.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <new>
#include <random>

namespace discretisation_msh_file_01
{
  std::atomic<std::size_t> largest_allocation{0};
}

// These are those of the whole program: other tests of it do not notice. Sanitizers have
// their own.
#ifndef __SANITIZE_ADDRESS__
void *
operator new(const std::size_t size)
{
  if (size > discretisation_msh_file_01::largest_allocation)
    discretisation_msh_file_01::largest_allocation = size;
  if (void *const memory = std::malloc(std::max<std::size_t>(size, 1)))
    return memory;
  throw std::bad_alloc();
}

void
operator delete(void *memory) noexcept
{
  std::free(memory);
}

void
operator delete(void *memory, std::size_t) noexcept
{
  std::free(memory);
}
#endif

namespace discretisation_msh_file_01
{
  using namespace geocone;

  void
  print(const std::string &what, const bool holds)
  {
    std::printf("  %s: %s\n", what.c_str(), holds ? "yes" : "NO");
  }

  /**
   * Two squares side by side, the left one of 2 x 2 quadrilaterals and the right
   * one of triangles, with physical curves and surfaces, of which the right
   * square is in two. Transfinite, so that all versions of gmsh make the same.
   */
  void
  make_model()
  {
    namespace geo = gmsh::model::geo;
    gmsh::model::add("squares");
    const std::array<std::array<double, 2>, 6> corners = {
      {{{0., 0.}}, {{1., 0.}}, {{2., 0.}}, {{2., 1.}}, {{1., 1.}}, {{0., 1.}}}};
    for (int i = 0; i < 6; ++i)
      geo::addPoint(corners[i][0], corners[i][1], 0., 0., i + 1);
    for (int i = 0; i < 6; ++i)
      geo::addLine(i + 1, (i + 1) % 6 + 1, i + 1);
    geo::addLine(2, 5, 7);
    geo::addPlaneSurface({geo::addCurveLoop({1, 7, 5, 6})}, 4);
    geo::addPlaneSurface({geo::addCurveLoop({2, 3, 4, -7})}, 2);
    for (int i = 1; i <= 7; ++i)
      geo::mesh::setTransfiniteCurve(i, 3);
    for (const int surface : {2, 4})
      geo::mesh::setTransfiniteSurface(surface);
    geo::mesh::setRecombine(2, 4);
    geo::synchronize();
    gmsh::model::addPhysicalGroup(1, {1, 2}, 11);
    gmsh::model::setPhysicalName(1, 11, "the bottom");
    gmsh::model::addPhysicalGroup(1, {3}, 12);
    gmsh::model::addPhysicalGroup(2, {4}, 21);
    gmsh::model::setPhysicalName(2, 21, "soil");
    gmsh::model::addPhysicalGroup(2, {2}, 22);
    gmsh::model::addPhysicalGroup(2, {2}, 23);
    gmsh::model::mesh::generate(2);
  }

  std::string
  text_by_gmsh(const double version, const int binary)
  {
    gmsh::option::setNumber("Mesh.MshFileVersion", version);
    gmsh::option::setNumber("Mesh.Binary", binary);
    gmsh::write("msh_file.msh");
    return content_of_file("msh_file.msh", "the file of gmsh");
  }

  /** Binary data in the other byte order. */
  class SwappedText
  {
  public:
    template <typename Number>
    SwappedText &
    operator<<(const Number value)
    {
      char raw[sizeof(Number)];
      std::memcpy(raw, &value, sizeof(Number));
      std::reverse(raw, raw + sizeof(Number));
      text.append(raw, sizeof(Number));
      return *this;
    }
    SwappedText &
    operator<<(const char *characters)
    {
      text += characters;
      return *this;
    }
    std::string text;
  };

  std::string
  swapped_22(const MshData &data)
  {
    SwappedText out;
    out << "$MeshFormat\n2.2 1 8\n" << 1 << "\n$EndMeshFormat\n";
    out << "$PhysicalNames\n1\n1 11 \"the bottom\"\n$EndPhysicalNames\n";
    out << ("$Nodes\n" + std::to_string(data.nodes.size()) + "\n").c_str();
    for (const auto &node : data.nodes)
      {
        out << static_cast<int>(node.tag);
        for (const double x : node.x)
          out << x;
      }
    // One block for each element and group, as gmsh writes them.
    std::size_t n = 0;
    SwappedText elements;
    for (const auto *list : {&data.faces, &data.cells})
      for (const auto &e : *list)
        for (const int group : data.group_lists[e.groups])
          {
            ++n;
            elements << e.type << 1 << 2 << static_cast<int>(n) << group
                     << e.entity;
            for (unsigned int i = 0; i < n_nodes_of_type(e.type); ++i)
              elements << static_cast<int>(e.nodes[i]);
          }
    out << ("\n$EndNodes\n$Elements\n" + std::to_string(n) + "\n").c_str();
    out.text += elements.text;
    out << "\n$EndElements\n";
    return out.text;
  }

  std::string
  swapped_41(const MshData &data)
  {
    using Size = std::uint64_t;
    SwappedText out;
    out << "$Comments\n$Nodes\n are not here\n$EndComments\n";
    out << "$MeshFormat\n4.1 1 8\n" << 1 << "\n$EndMeshFormat\n";
    out << "$PhysicalNames\n1\n1 11 \"the bottom\"\n$EndPhysicalNames\n";
    std::map<std::pair<int, int>, unsigned int> groups;
    for (const auto &e : data.faces)
      groups[{1, e.entity}] = e.groups;
    for (const auto &e : data.cells)
      groups[{2, e.entity}] = e.groups;
    std::array<Size, 4> n_entities = {};
    for (const auto &entry : groups)
      ++n_entities[entry.first.first];
    out << "$Entities\n";
    for (const Size n : n_entities)
      out << n;
    for (const auto &[entity, list] : groups)
      {
        out << entity.second;
        for (unsigned int c = 0; c < 6; ++c)
          out << 0.;
        out << Size(data.group_lists[list].size());
        for (const int group : data.group_lists[list])
          out << -group; // the sign is an orientation
        out << Size(2) << 7 << -8;
      }
    out << "\n$EndEntities\n$Nodes\n";
    out << Size(1) << Size(data.nodes.size()) << Size(1) << Size(99);
    out << 2 << 4 << 1 << Size(data.nodes.size());
    for (const auto &node : data.nodes)
      out << Size(node.tag);
    for (const auto &node : data.nodes)
      out << node.x[0] << node.x[1] << node.x[2] << 0.5 << 0.5;
    out << "\n$EndNodes\n$Elements\n";
    const Size n = data.faces.size() + data.cells.size();
    out << n << n << Size(1) << Size(99);
    for (const auto *list : {&data.faces, &data.cells})
      for (const auto &e : *list)
        {
          out << (list == &data.faces ? 1 : 2) << e.entity << e.type << Size(1)
              << Size(e.tag);
          for (unsigned int i = 0; i < n_nodes_of_type(e.type); ++i)
            out << Size(e.nodes[i]);
        }
    out << "\n$EndElements\n";
    return out.text;
  }

  bool
  same(const CoarseMesh &a, const CoarseMesh &b)
  {
    const auto same_points = [](const dealii::Point<dim> &x,
                                const dealii::Point<dim> &y) {
      return x.distance(y) < 1e-15; // ASCII has 16 digits
    };
    const auto same_cells = [](const auto &x, const auto &y) {
      return x.vertices == y.vertices && x.material_id == y.material_id;
    };
    return a.points.size() == b.points.size() &&
           std::equal(
             a.points.begin(), a.points.end(), b.points.begin(), same_points) &&
           a.cells.size() == b.cells.size() &&
           std::equal(
             a.cells.begin(), a.cells.end(), b.cells.begin(), same_cells) &&
           a.boundary.boundary_lines.size() ==
             b.boundary.boundary_lines.size() &&
           std::equal(a.boundary.boundary_lines.begin(),
                      a.boundary.boundary_lines.end(),
                      b.boundary.boundary_lines.begin(),
                      same_cells) &&
           a.sides == b.sides;
  }

  void
  test(int argc, char **argv)
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi_session(argc, argv, 1);
    const ParameterFile                      parameters =
      ParameterFile::from_text("subsection Materials\n"
                               "  set Names = soil, sand, clay\n"
                               "  subsection soil\n"
                               "  end\n"
                               "  subsection sand\n"
                               "    set Region number = 21\n"
                               "  end\n"
                               "  subsection clay\n"
                               "    set Region number = 23\n"
                               "  end\n"
                               "end\n",
                               "materials",
                               {});
    Scene scene(parameters);
    parameters.parse();
    const Regions &regions = scene.regions;

    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    make_model();
    std::vector<std::pair<std::string, std::string>> texts;
    for (const double version : {2.2, 4.1})
      for (const int binary : {0, 1})
        texts.emplace_back((version > 4. ? "version 4.1, " : "version 2.2, ") +
                             std::string(binary == 1 ? "binary" : "ASCII"),
                           text_by_gmsh(version, binary));
    gmsh::finalize();
    const MshData first = parse_msh(texts[0].second, "the mesh");
    texts.emplace_back("version 2.2, other byte order", swapped_22(first));
    texts.emplace_back("version 4.1, other byte order", swapped_41(first));

    const CoarseMesh mesh = coarse_mesh(first, "the mesh", regions);
    std::printf("%zu vertices, %zu cells, %zu edges of sides\n",
                mesh.points.size(),
                mesh.cells.size(),
                mesh.boundary.boundary_lines.size());
    for (const auto &side : mesh.sides)
      std::printf("side '%s' has number %u\n", side.first.c_str(), side.second);
    std::map<std::pair<unsigned int, std::size_t>, unsigned int> n_cells;
    for (const auto &cell : mesh.cells)
      ++n_cells[{cell.material_id, cell.vertices.size()}];
    for (const auto &[kind, n] : n_cells)
      std::printf("material %u: %u cells with %zu vertices\n",
                  kind.first,
                  n,
                  kind.second);

    // The standard fixes this generator's numbers, but not the distributions'.
    std::mt19937 random(1);
    for (const auto &[name, text] : texts)
      {
        std::printf("%s\n", name.c_str());
        print(
          "is the same mesh",
          same(mesh,
               coarse_mesh(parse_msh(text, "the mesh"), "the mesh", regions)));

        unsigned int n_read = 0, n_refused = 0;
        bool         with_remedy = true;
        largest_allocation       = 0;
        const auto try_text      = [&](const std::string &damaged) {
          try
            {
              coarse_mesh(parse_msh(damaged, "the mesh"), "the mesh", regions);
              ++n_read;
              return true;
            }
          catch (const InputError &error)
            {
              ++n_refused;
              with_remedy &= std::string(error.what()).find("\n  remedy:  ") !=
                             std::string::npos;
              return false;
            }
        };

        // Without its last section, or any part of it, it is not complete.
        const std::size_t end  = text.rfind("$EndElements") + 12;
        bool              none = true;
        for (std::size_t n = 0; n < end; n += 1 + text.size() / 400)
          none &= !try_text(text.substr(0, n));
        none &= !try_text(text.substr(0, end - 1));
        print("refused if it is cut, wherever", none);

        for (unsigned int i = 0; i < 300; ++i)
          {
            std::string damaged = text;
            for (unsigned int n = 0; n <= i % 3; ++n)
              damaged[random() % text.size()] = static_cast<char>(random());
            try_text(damaged);
          }
        // Numbers in text, and the bytes of numbers, replaced.
        const bool is_ascii = name.find("ASCII") != std::string::npos;
        for (std::size_t i = 0; i < text.size(); i += is_ascii ? 1 : 4)
          if (is_ascii &&
              (i == 0 || !std::isspace(text[i - 1]) || std::isspace(text[i])))
            continue;
          else if (is_ascii)
            {
              const std::size_t after =
                std::min(text.find_first_of(" \n", i), text.size());
              const std::vector<std::string> replacements = {
                "18446744073709551615",
                "4294967297",
                "2147483647",
                "1000000",
                "-2147483648",
                "-1",
                "0",
                "nan",
                "inf",
                "1e400",
                "1e-400",
                "1e15",
                "1.5",
                "x",
                "",
                "\""};
              try_text(text.substr(0, i) +
                       replacements[random() % replacements.size()] +
                       text.substr(after));
            }
          else
            {
              std::string  damaged   = text;
              const double undefined = std::numeric_limits<double>::quiet_NaN();
              const std::uint64_t huge  = 1ULL << (random() % 64);
              const int           wrong = static_cast<int>(random() % 5) - 2;
              const std::array<std::string, 4> replacements = {
                {std::string(reinterpret_cast<const char *>(&undefined), 8),
                 std::string(reinterpret_cast<const char *>(&huge), 8),
                 std::string(reinterpret_cast<const char *>(&wrong), 4),
                 std::string(8, '\xff')}};
              const std::string &bytes = replacements[random() % 4];
              damaged.replace(i, bytes.size(), bytes);
              damaged.resize(text.size());
              try_text(damaged);
            }
        print("more than 500 damaged files, read or refused with a remedy",
              n_read + n_refused > 500 && n_read > 0 && with_remedy);
        print("no allocation of more than 64 times the file",
              largest_allocation < 64 * text.size());
      }

    // The largest of numbers are refused before anything is allocated for them.
    std::printf("what is not refused:\n");
    largest_allocation = 0;
    for (const std::string text : {
           "",
           "$",
           "$End",
           "$MeshFormat",
           "$MeshFormat\n2.2 0 8\n$EndMeshFormat",
           "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 "
           "18446744073709551615 1 1\n2 1 0 18446744073709551615\n",
           "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 "
           "18446744073709551615 0 0\n1 0 0 0 0 0 0 18446744073709551615\n",
           "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2147483647\n",
           "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n"
           "$Elements\n2147483647\n1 2 2147483647 1 1 1 1\n",
           "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n"
           "$Elements\n0\n$EndElements\n",
           "$Comments\n$MeshFormat\n2.2 0 8\n",
           "$MeshFormat\n4 0 8\n$EndMeshFormat\n",
           "$MeshFormat\n4.1 1 4\n$EndMeshFormat\n",
           "$MeshFormat\n4.1 1 8\n$EndMeshFormat\n",
           "$NOD\n1\n1 0 0 0\n$ENDNOD\n",
         })
      try
        {
          coarse_mesh(parse_msh(text, "the mesh"), "the mesh", regions);
          std::printf("%s\n", text.c_str());
        }
      catch (const InputError &)
        {}
    print("no allocation of more than 64 kB", largest_allocation < 65536);
  }

  const RegisteredTest registered(__FILE__, test);
} // namespace discretisation_msh_file_01
