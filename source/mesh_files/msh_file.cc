// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <geocone/base/exceptions.h>
#include <geocone/base/log.h>
#include <geocone/mesh_files/msh_scanner.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>

namespace geocone::GEOCONE_DIM
{
  namespace
  {
    // Five million nodes in ASCII, far beyond the limit of the solvers.
    constexpr std::uintmax_t largest_msh_file = 512ULL << 20;

    /** Quadratic elements: the linear type of their corners, which come first, the
     *  number of their nodes, and the ends of the edge of each node in the middle of
     *  an edge. Other nodes lie in faces and cells. */
    struct QuadraticType
    {
      int                                  type, linear;
      unsigned int                         n_nodes;
      std::vector<std::pair<short, short>> edges;
    };

    const QuadraticType *
    quadratic(const int type)
    {
      static const std::vector<std::pair<short, short>>
        of_triangle      = {{0, 1}, {1, 2}, {2, 0}},
        of_quadrilateral = {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
        of_tetrahedron   = {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}},
        of_hexahedron    = {{0, 1},
                            {0, 3},
                            {0, 4},
                            {1, 2},
                            {1, 5},
                            {2, 3},
                            {2, 6},
                            {3, 7},
                            {4, 5},
                            {4, 7},
                            {5, 6},
                            {6, 7}};
      static const QuadraticType all[] = {
        {8, MshData::line, 3, {}},
        {9, MshData::triangle, 6, of_triangle},
        {10, MshData::quadrilateral, 9, of_quadrilateral},
        {16, MshData::quadrilateral, 8, of_quadrilateral},
        {11, MshData::tetrahedron, 10, of_tetrahedron},
        {12, MshData::hexahedron, 27, of_hexahedron},
        {17, MshData::hexahedron, 20, of_hexahedron}};
      for (const QuadraticType &one : all)
        if (one.type == type)
          return &one;
      return nullptr;
    }

    int
    linear_type(const int type)
    {
      const QuadraticType *const more = quadratic(type);
      return more == nullptr ? type : more->linear;
    }

    /** Reads one file, section by section. */
    class Reader
    {
    public:
      Reader(const std::string &text, const std::string &what)
        : in(text, what)
        , what(what)
      {}

      MshData
      read()
      {
        std::set<std::string> seen;
        while (!in.at_end())
          {
            const std::string header = in.word("a section");
            if (header.size() < 2 || header[0] != '$' ||
                header.compare(0, 4, "$End") == 0)
              in.refuse("there is " + shown_part(header) +
                        " where a section should begin");
            const std::string name = header.substr(1);
            in.end_line();
            const bool known = name == "MeshFormat" || name == "Entities" ||
                               name == "PhysicalNames" || name == "Nodes" ||
                               name == "Elements";
            if (name == "NOD" || name == "ELM")
              in.refuse("it is of version 1");
            if (name == "PartitionedEntities")
              in.refuse("the mesh is partitioned",
                        "write it in one part: in gmsh, Mesh > Unpartition");
            if (name == "ParametricNodes")
              in.refuse("its nodes have parametric coordinates",
                        "write it with Mesh.SaveParametric = 0");
            if (known && !seen.insert(name).second)
              in.refuse("there is a second section $" + name);
            if (known && name != "MeshFormat" && seen.count("MeshFormat") == 0)
              in.refuse("the section " + shown_part("$" + name) +
                        " stands before $MeshFormat");

            if (!known || (name == "Entities" && !four))
              {
                in.skip_section(name);
                continue;
              }
            if (name == "MeshFormat")
              mesh_format();
            else if (name == "PhysicalNames")
              physical_names();
            else if (name == "Entities")
              entities();
            else if (name == "Nodes")
              four ? nodes_of_blocks() : nodes();
            else
              four ? elements_of_blocks() : elements();
            in.end_section(name);
          }
        for (const char *name : {"MeshFormat", "Nodes", "Elements"})
          if (seen.count(name) == 0)
            in.refuse(std::string("the file ends without the section $") + name,
                      "it is not complete: copy or write it again, with all "
                      "elements");
        four ? take_groups_of_entities() : merge_copies();
        check_middles();
        return std::move(data);
      }

    private:
      void
      mesh_format()
      {
        const std::string version = in.word("the version");
        const int         binary = in.integer_in_text("the type of file", 0, 1);
        const int size = in.integer_in_text("the size of numbers", 0, 64);
        if (version != "2.2" && version != "4.1")
          in.refuse("it is of version " + shown_part(version));
        if (binary != 0 && size != 8)
          in.refuse("its numbers have " + std::to_string(size) +
                    " bytes instead of 8");
        four = version == "4.1";
        in.end_line();
        if (binary != 0)
          {
            in.set_binary(false);
            const int one = in.integer<int>("the number one");
            if (one == 1 << 24)
              in.set_binary(true);
            else if (one != 1)
              in.refuse("the number that shows the byte order is " +
                        std::to_string(one) + " instead of 1");
          }
      }

      void
      physical_names()
      {
        const int n = in.integer_in_text(
          "the number of names", 0, std::numeric_limits<int>::max());
        for (int i = 0; i < n; ++i)
          {
            const int dimension =
              in.integer_in_text("the dimension of a physical group", 0, 3);
            const int number =
              in.integer_in_text("the number of a physical group",
                                 1,
                                 std::numeric_limits<int>::max());
            const std::string name = in.quoted("the name of a physical group");
            if (std::any_of(name.begin(), name.end(), [](const char c) {
                  return (c >= 0 && c < ' ') || c == 127;
                }))
              in.refuse("the name " + shown_part(name) +
                          " has unprintable letters",
                        "rename the physical group");
            if (name.empty() || dimension < int(dim) - 1 ||
                dimension > int(dim))
              continue;
            const bool is_face = dimension < int(dim);
            auto      &names   = is_face ? data.face_names : data.cell_names;
            if (!names.emplace(number, name).second)
              in.refuse("the physical " + (is_face ? face_word : cell_word) +
                          " " + std::to_string(number) + " has two names",
                        "delete one of them");
          }
      }

      /** Version 4.1: groups of points, curves, ... */
      void
      entities()
      {
        have_entities = true;
        std::array<std::uint64_t, 4> n;
        for (std::uint64_t &count : n)
          count = in.integer<std::uint64_t>("a number of entities");
        for (int dimension = 0; dimension < 4; ++dimension)
          for (std::uint64_t i = 0; i < n[dimension]; ++i)
            {
              const int entity = in.integer<int>("the number of an entity");
              // A point has its coordinates, the others their bounding box.
              for (int c = 0; c < (dimension == 0 ? 3 : 6); ++c)
                in.number("a coordinate of an entity");
              const auto n_groups =
                in.integer<std::uint64_t>("the number of physical groups");
              in.check_room(
                n_groups, in.is_binary() ? sizeof(int) : 2, "physical groups");
              std::vector<int> groups;
              for (std::uint64_t g = 0; g < n_groups; ++g)
                if (const int group = group_number())
                  groups.push_back(group);
              if (dimension > 0)
                in.skip_integers<int>(
                  in.integer<std::uint64_t>("the number of bounding entities"),
                  "bounding entities");
              if (dimension == int(dim) - 1)
                data.face_groups.insert(groups.begin(), groups.end());
              if ((dimension == int(dim) - 1 || dimension == int(dim)) &&
                  !groups_of_entity[dimension]
                     .emplace(entity, data.index_of_groups(groups))
                     .second)
                in.refuse("the entity " + std::to_string(entity) +
                          " of dimension " + std::to_string(dimension) +
                          " is defined twice");
            }
      }

      /** Number of a physical group; its sign is an orientation. */
      int
      group_number()
      {
        return std::abs(in.integer<int>("the number of a physical group",
                                        -std::numeric_limits<int>::max()));
      }

      void
      node(const std::uint64_t tag)
      {
        MshData::Node node;
        node.tag = tag;
        for (double &x : node.x)
          x = in.number("a coordinate of a node");
        data.nodes.push_back(node);
      }

      void
      nodes()
      {
        const int n = in.integer_in_text(
          "the number of nodes", 0, std::numeric_limits<int>::max());
        if (in.is_binary())
          in.end_line();
        // "1 0 0 0\n" is the shortest node.
        in.check_room(n, in.is_binary() ? 4 + 24 : 8, "nodes");
        data.nodes.reserve(n);
        for (int i = 0; i < n; ++i)
          node(in.integer("the tag of a node", 1));
      }

      void
      nodes_of_blocks()
      {
        const auto n_blocks = in.integer<std::uint64_t>("a number of blocks");
        const auto n_nodes  = in.integer<std::uint64_t>("the number of nodes");
        in.integer<std::uint64_t>("the smallest tag");
        in.integer<std::uint64_t>("the largest tag");
        in.check_room(n_nodes, in.is_binary() ? 8 + 24 : 8, "nodes");
        data.nodes.reserve(n_nodes);
        std::vector<std::uint64_t> tags;
        for (std::uint64_t b = 0; b < n_blocks; ++b)
          {
            const int dimension = in.integer("the dimension of nodes", 0, 3);
            in.integer<int>("the number of an entity");
            const int  parametric = in.integer("the mark of parameters", 0, 1);
            const auto n = in.integer<std::uint64_t>("the number of nodes");
            in.check_room(n, in.is_binary() ? 8 + 24 : 8, "nodes");
            tags.clear();
            tags.reserve(n);
            for (std::uint64_t i = 0; i < n; ++i)
              tags.push_back(in.integer<std::uint64_t>("the tag of a node", 1));
            for (const std::uint64_t tag : tags)
              {
                node(tag);
                for (int c = 0; c < parametric * dimension; ++c)
                  in.number("a parametric coordinate of a node");
              }
          }
        check_number("nodes", n_nodes, data.nodes.size());
      }

      void
      check_number(const std::string  &items,
                   const std::uint64_t announced,
                   const std::uint64_t found) const
      {
        if (announced != found)
          in.refuse("it announces " + std::to_string(announced) + " " + items +
                      ", but its blocks hold " + std::to_string(found),
                    "copy it again, or " + msh_remedy);
      }

      /** Reads the nodes of an element and keeps it if it is a cell or a face. */
      void
      element(const std::uint64_t tag,
              const int           type,
              const int           entity,
              const unsigned int  groups)
      {
        const QuadraticType *const more = quadratic(type);
        MshData::Element element = {tag, linear_type(type), entity, groups, {}};
        const unsigned int n     = n_nodes_of_type(element.type);
        const unsigned int n_all = more ? more->n_nodes : n;
        const bool is_cell       = dimension_of_type(element.type) == int(dim);
        for (unsigned int i = 0; i < n_all; ++i)
          {
            const std::uint64_t node =
              four ? in.integer<std::uint64_t>("a node of an element", 1)
                   : in.integer("a node of an element", 1);
            if (i < n)
              element.nodes[i] = node;
            else if (is_cell && i - n < more->edges.size())
              middles.push_back({tag,
                                 element.nodes[more->edges[i - n].first],
                                 element.nodes[more->edges[i - n].second],
                                 node});
          }
        if (is_cell)
          data.cells.push_back(element);
        else if (dimension_of_type(element.type) == int(dim) - 1)
          data.faces.push_back(element);
      }

      /** @throws InputError if a node of a quadratic cell is not in the middle of
       *  its edge: edges of cells are straight */
      void
      check_middles() const
      {
        if (middles.empty())
          return;
        std::vector<std::pair<std::uint64_t, const MshData::Node *>> nodes;
        for (const MshData::Node &node : data.nodes)
          nodes.emplace_back(node.tag, &node);
        std::sort(nodes.begin(), nodes.end());
        const auto place = [&](const std::uint64_t tag, const Middle &middle) {
          const auto at = std::lower_bound(
            nodes.begin(),
            nodes.end(),
            std::make_pair(tag, static_cast<const MshData::Node *>(nullptr)));
          if (at == nodes.end() || at->first != tag)
            in.refuse("the node " + std::to_string(tag) + " of the element " +
                        std::to_string(middle.element) + " is missing",
                      msh_remedy);
          return at->second->x;
        };
        constexpr double tolerance = 1e-3; // of the edge, also for short texts
        for (const Middle &middle : middles)
          {
            const auto a = place(middle.first, middle),
                       b = place(middle.last, middle),
                       m = place(middle.node, middle);
            double edge = 0., off = 0.;
            for (unsigned int c = 0; c < 3; ++c)
              {
                edge += (b[c] - a[c]) * (b[c] - a[c]);
                off +=
                  (m[c] - (a[c] + b[c]) / 2.) * (m[c] - (a[c] + b[c]) / 2.);
              }
            if (!(off <= tolerance * tolerance * edge))
              throw InputError(
                what + ": an edge of the quadratic element " +
                std::to_string(middle.element) + " is curved at " +
                format("(%g, %g, %g)", m[0], m[1], m[2]) +
                format(", by %.2g of its length", std::sqrt(off / edge)) +
                "\n  allowed: quadratic elements with straight edges, of which "
                "the corners count\n  remedy:  mesh with Mesh.ElementOrder = "
                "1, "
                "in smaller cells along curves: edges are chords");
          }
      }

      /** Version 2.2: tags of an element are its group, its entity, others. */
      void
      element_with_tags(const int tag, const int type, const int n_tags)
      {
        int group = 0, entity = 0;
        if (n_tags > 0)
          group = group_number();
        if (n_tags > 1)
          entity = in.integer<int>("the entity of an element");
        if (n_tags > 2)
          in.skip_integers<int>(n_tags - 2, "tags");
        if (dimension_of_type(linear_type(type)) == int(dim) - 1 && group > 0)
          data.face_groups.insert(group);
        element(
          tag, type, entity, group > 0 ? data.index_of_groups({group}) : 0);
      }

      void
      elements()
      {
        const int n = in.integer_in_text(
          "the number of elements", 0, std::numeric_limits<int>::max());
        constexpr int all = std::numeric_limits<int>::max();
        if (!in.is_binary())
          {
            // "1 15 0 1\n" is the shortest element.
            in.check_room(n, 9, "elements");
            for (int i = 0; i < n; ++i)
              {
                const int tag  = in.integer("the tag of an element", 1);
                const int type = in.integer<int>("the type of an element");
                check_element_type(
                  linear_type(type), what, " " + std::to_string(tag));
                element_with_tags(
                  tag, type, in.integer("the number of tags", 0, all));
              }
            return;
          }
        in.end_line();
        in.check_room(n, 2 * sizeof(int), "elements");
        for (int found = 0; found < n;)
          {
            const int type = in.integer<int>("the type of elements");
            check_element_type(linear_type(type), what, "");
            const int n_block =
              in.integer("the number of elements of a block", 1, n - found);
            const int n_tags = in.integer("the number of tags", 0, all);
            for (int i = 0; i < n_block; ++i)
              element_with_tags(
                in.integer("the tag of an element", 1), type, n_tags);
            found += n_block;
          }
      }

      void
      elements_of_blocks()
      {
        const auto n_blocks = in.integer<std::uint64_t>("a number of blocks");
        const auto n_all = in.integer<std::uint64_t>("the number of elements");
        in.integer<std::uint64_t>("the smallest tag");
        in.integer<std::uint64_t>("the largest tag");
        std::uint64_t found = 0;
        for (std::uint64_t b = 0; b < n_blocks; ++b)
          {
            const int dimension = in.integer("the dimension of elements", 0, 3);
            const int entity    = in.integer<int>("the number of an entity");
            const int type      = in.integer<int>("the type of elements");
            check_element_type(linear_type(type), what, "");
            if (dimension != dimension_of_type(linear_type(type)))
              in.refuse("elements of gmsh's type " + std::to_string(type) +
                        " in an entity of dimension " +
                        std::to_string(dimension));
            const auto n = in.integer<std::uint64_t>("the number of elements");
            // "1 1\n" is the shortest element.
            in.check_room(n, in.is_binary() ? 16 : 4, "elements");
            for (std::uint64_t i = 0; i < n; ++i)
              element(in.integer<std::uint64_t>("the tag of an element"),
                      type,
                      entity,
                      0);
            found += n;
          }
        check_number("elements", n_all, found);
      }

      void
      take_groups_of_entities()
      {
        for (const int dimension : {int(dim) - 1, int(dim)})
          for (MshData::Element &element :
               dimension == int(dim) ? data.cells : data.faces)
            {
              const auto entity =
                groups_of_entity[dimension].find(element.entity);
              if (entity != groups_of_entity[dimension].end())
                element.groups = entity->second;
              else if (have_entities)
                in.refuse("the element " + std::to_string(element.tag) +
                          " belongs to the entity " +
                          std::to_string(element.entity) + " of dimension " +
                          std::to_string(dimension) +
                          ", which is not in $Entities");
            }
      }

      /**
       * Merges the copies of an element in version 2.2, one for each of its
       * physical groups, into one element with several groups.
       */
      void
      merge_copies()
      {
        for (auto *elements : {&data.faces, &data.cells})
          {
            std::vector<std::size_t> order(elements->size());
            std::iota(order.begin(), order.end(), std::size_t(0));
            const auto key = [&](const std::size_t i) {
              const MshData::Element &e = (*elements)[i];
              return std::make_tuple(e.entity, e.type, e.nodes);
            };
            std::sort(order.begin(),
                      order.end(),
                      [&](const std::size_t a, const std::size_t b) {
                        const auto ka = key(a), kb = key(b);
                        return ka < kb || (ka == kb && a < b);
                      });
            std::vector<bool> is_copy(elements->size(), false);
            for (std::size_t i = 0, j; i < order.size(); i = j)
              {
                std::set<int> groups;
                for (j = i; j < order.size() && key(order[j]) == key(order[i]);
                     ++j)
                  {
                    const auto &own =
                      data.group_lists[(*elements)[order[j]].groups];
                    groups.insert(own.begin(), own.end());
                    is_copy[order[j]] = j > i;
                  }
                if (j > i + 1)
                  (*elements)[order[i]].groups =
                    data.index_of_groups({groups.begin(), groups.end()});
              }
            std::vector<MshData::Element> kept;
            for (std::size_t i = 0; i < elements->size(); ++i)
              if (!is_copy[i])
                kept.push_back((*elements)[i]);
            *elements = std::move(kept);
          }
      }

      MshScanner         in;
      const std::string &what;
      MshData            data;
      /** A node in the middle of an edge of a quadratic cell. */
      struct Middle
      {
        std::uint64_t element, first, last, node;
      };
      std::vector<Middle>                        middles;
      bool                                       four          = false;
      bool                                       have_entities = false;
      std::array<std::map<int, unsigned int>, 4> groups_of_entity;
    };
  } // namespace

  unsigned int
  MshData::index_of_groups(const std::vector<int> &groups)
  {
    const auto [list, is_new] =
      index_of_list.emplace(groups, group_lists.size());
    if (is_new)
      group_lists.push_back(groups);
    return list->second;
  }

  unsigned int
  n_nodes_of_type(const int type)
  {
    return type == MshData::point         ? 1
           : type == MshData::hexahedron  ? 8
           : type == MshData::tetrahedron ? 4
                                          : type + 1;
  }

  int
  dimension_of_type(const int type)
  {
    return type == MshData::point           ? 0
           : type == MshData::line          ? 1
           : type <= MshData::quadrilateral ? 2
                                            : 3;
  }

  void
  check_element_type(const int          type,
                     const std::string &what,
                     const std::string &element)
  {
    if (type != MshData::point &&
        (type < MshData::line ||
         type > (dim == 2 ? MshData::quadrilateral : MshData::hexahedron)))
      throw InputError(
        what +
        (element.empty() ? " has elements"
                         : ": the element" + element + " is") +
        " of gmsh's type " + std::to_string(type) +
        (dim == 2
           ? "\n  allowed: lines, triangles and quadrilaterals of first order "
             "(in .msh files also of second order), and points\n  remedy:  "
             "mesh the plane only, with "
             "Mesh.ElementOrder = 1"
           : "\n  allowed: lines, triangles, quadrilaterals, tetrahedra and "
             "hexahedra of first order (in .msh files also of second order), "
             "and points\n  remedy:  "
             "mesh with Mesh.ElementOrder = 1"));
  }

  bool
  begins_as_msh(const std::string &text)
  {
    std::size_t begin = 0;
    while (begin < text.size() && is_msh_space(text[begin]))
      ++begin;
    for (const char *section : {"$MeshFormat", "$Comments", "$NOD"})
      if (text.compare(begin, std::strlen(section), section) == 0)
        return true;
    return false;
  }

  std::string
  content_of_file(const std::string &file_name, const std::string &what)
  {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file_name, error))
      throw InputError(what + " is no regular file\n  allowed: " +
                       msh_versions + "\n  remedy:  check its name");
    const std::uintmax_t size = std::filesystem::file_size(file_name, error);
    if (!error && size > largest_msh_file)
      throw InputError(
        what +
        format(" has %.0f MB\n  allowed: files up to %.0f MB\n",
               size / 1048576.,
               largest_msh_file / 1048576.) +
        "  remedy:  mesh with fewer cells, or write the file in binary: "
        "Mesh.Binary = 1");
    std::string   text(error ? 0 : size, '\0');
    std::ifstream file(file_name, std::ios::binary);
    if (error || !file || (size > 0 && !file.read(&text[0], size)))
      throw InputError(what + " cannot be read\n  allowed: " + msh_versions +
                       "\n  remedy:  check its permissions");
    return text;
  }

  MshData
  parse_msh(const std::string &text, const std::string &what)
  {
    return Reader(text, what).read();
  }
} // namespace geocone::GEOCONE_DIM
