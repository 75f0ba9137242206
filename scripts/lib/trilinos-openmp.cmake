# Trilinos 13.2 with Kokkos OpenMP, as an initial cache (cmake -C). The Serial device stays in Kokkos
# for host mirrors; Tpetra and KokkosKernels are instantiated for OpenMP only.
foreach(setting IN ITEMS
    CMAKE_BUILD_TYPE=Release CMAKE_C_COMPILER=mpicc CMAKE_CXX_COMPILER=mpicxx CMAKE_CXX_STANDARD=17
    "CMAKE_C_FLAGS=-O3 -w" "CMAKE_CXX_FLAGS=-O3 -w" BUILD_SHARED_LIBS=ON
    TPL_ENABLE_MPI=ON TPL_ENABLE_METIS=ON TPL_ENABLE_MUMPS=ON TPL_ENABLE_Cholmod=ON
    Cholmod_INCLUDE_DIRS=/usr/include/suitesparse
    Trilinos_ENABLE_Fortran=OFF Trilinos_ENABLE_TESTS=OFF Trilinos_ENABLE_EXAMPLES=OFF
    Trilinos_ENABLE_ALL_OPTIONAL_PACKAGES=OFF Trilinos_ENABLE_EXPLICIT_INSTANTIATION=ON
    Trilinos_ENABLE_OpenMP=ON Kokkos_ENABLE_OPENMP=ON Kokkos_ENABLE_SERIAL=ON
    KokkosKernels_INST_EXECSPACE_SERIAL=OFF Tpetra_INST_OPENMP=ON Tpetra_INST_SERIAL=OFF
    Tpetra_INST_INT_LONG_LONG=ON Tpetra_INST_DOUBLE=ON
    Amesos2_ENABLE_KLU2=ON Amesos2_ENABLE_ShyLU_NodeTacho=ON Amesos2_ENABLE_Epetra=OFF
    NOX_ENABLE_LOCA=ON NOX_ENABLE_ABSTRACT_IMPLEMENTATION_THYRA=ON)
  string(REGEX MATCH "^([^=]+)=(.*)$" ignored "${setting}")
  set(${CMAKE_MATCH_1} "${CMAKE_MATCH_2}" CACHE STRING "")
endforeach()
set(Trilinos_ENABLE_Epetra OFF CACHE BOOL "")
foreach(package IN ITEMS Teuchos Kokkos KokkosKernels Tpetra Sacado Shards Intrepid2 Belos Amesos2 Ifpack2
    ShyLU_NodeTacho Anasazi Thyra ThyraTpetraAdapters Stratimikos NOX)
  set(Trilinos_ENABLE_${package} ON CACHE BOOL "")
endforeach()
