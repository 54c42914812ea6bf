// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef geocone_mesh_msh_file_h
#define geocone_mesh_msh_file_h

#include <geocone/base/types.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/set.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace geocone::GEOCONE_DIM
{
  /**
   * Nodes, elements and physical groups in gmsh's terms, as they are in a .msh
   * file or in a model of the gmsh library. Only linear elements: lines, triangles and
   * quadrilaterals, and in three dimensions tetrahedra and hexahedra, too. Cells are
   * those of the dimension of the scene, faces those of one less.
   */
  struct MshData
  {
    /** gmsh's numbers of the types of elements that a mesh consists of. */
    enum Type
    {
      line          = 1,
      triangle      = 2,
      quadrilateral = 3,
      tetrahedron   = 4,
      hexahedron    = 5,
      point         = 15
    };

    struct Node
    {
      std::uint64_t         tag;
      std::array<double, 3> x;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &tag &x;
      }
    };

    struct Element
    {
      std::uint64_t tag;
      int           type;
      /** The curve, surface or volume that the element belongs to. */
      int entity;
      /** Index into #group_lists. */
      unsigned int groups;
      /** Tags of the nodes, zero after the last one. */
      std::array<std::uint64_t, 8> nodes;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &tag &type &entity &groups &nodes;
      }
    };

    /**
     * The index of a list of physical groups in #group_lists, to which it is
     * added if it is new.
     */
    unsigned int
    index_of_groups(const std::vector<int> &groups);

    std::vector<Node>    nodes;
    std::vector<Element> cells, faces;

    /** Numbers (> 0) of the physical groups that an element is in. */
    std::vector<std::vector<int>> group_lists = {{}};

    /** The physical groups of faces: curves, or surfaces. */
    std::set<int> face_groups;

    /** Their names by their numbers, and those of groups of cells. */
    std::map<int, std::string> face_names, cell_names;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &nodes &cells &faces &group_lists &face_groups &face_names
        &cell_names &place_of_list;
    }

  private:
    std::map<std::vector<int>, unsigned int> place_of_list = {{{}, 0}};
  };

  /** How a damaged file is mended. */
  inline const std::string msh_remedy =
    "write it anew, e.g.: gmsh OLD.msh -save -format msh41 -o NEW.msh";

  /** Names in gmsh of the faces of cells, and of parts that cells fill. */
  const std::string face_word = dim == 2 ? "curve" : "surface";
  const std::string cell_word = dim == 2 ? "surface" : "volume";

  /** The number of nodes of an element of one of MshData's types, and its
   *  dimension. */
  unsigned int
  n_nodes_of_type(const int type);
  int
  dimension_of_type(const int type);

  /**
   * @throws InputError if elements of gmsh's @p type cannot be in a mesh; @p
   * what names the mesh, and @p element, which may be empty, the element
   */
  void
  check_element_type(const int          type,
                     const std::string &what,
                     const std::string &element);

  /**
   * Whether a text begins as a .msh file does: with the section MeshFormat, or
   * with comments before it.
   */
  bool
  begins_as_msh(const std::string &text);

  /**
   * The content of a regular file, which may be binary.
   * @throws InputError if it is something else, cannot be read, or is larger
   * than 512 MB: meshes of five million nodes are smaller
   */
  std::string
  content_of_file(const std::string &file_name, const std::string &what);

  /**
   * Reads the text of a .msh file of version 2.2 or 4.1, ASCII or binary in
   * either byte order. It is read as data: nothing in it is executed. Memory is
   * bounded by a multiple of the length of the text, whatever numbers it holds.
   * Sections that say nothing of nodes and elements are skipped.
   * @param what what errors call it
   * @throws InputError with the line (of a binary file: the byte) if the text is
   * of another version, damaged, or inconsistent, or holds other elements than
   * MshData's types
   */
  MshData
  parse_msh(const std::string &text, const std::string &what);
} // namespace geocone::GEOCONE_DIM

#endif
