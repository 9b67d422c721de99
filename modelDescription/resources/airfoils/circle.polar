# Circular cylinder, for blade roots. Made by provenance/airfoil-tables/make_tables.py; do not edit.
# Reynolds number on the diameter, drag coefficient on the frontal area, smooth surface, no lift.
# Source: Wieselsberger, C. (1921), Physikalische Zeitschrift 22, 321-328, as plotted in
# Schlichting, Boundary-Layer Theory, and Hoerner, Fluid-Dynamic Drag (1965); above Re 8e5
# Roshko, A. (1961), Journal of Fluid Mechanics 10, 345-356.
# Approximate: round values of the published curves, about +-10 % outside the drag crisis. Between
# Re 2e5 and 1e6 drag depends on roughness and turbulence and may differ by a factor of two.
polar 1
name circular cylinder

reynolds 100
# alpha_deg      cl       cd
     -180.0   0.0000  1.40000
        0.0   0.0000  1.40000
      180.0   0.0000  1.40000

reynolds 1000
# alpha_deg      cl       cd
     -180.0   0.0000  1.00000
        0.0   0.0000  1.00000
      180.0   0.0000  1.00000

reynolds 3000
# alpha_deg      cl       cd
     -180.0   0.0000  0.95000
        0.0   0.0000  0.95000
      180.0   0.0000  0.95000

reynolds 10000
# alpha_deg      cl       cd
     -180.0   0.0000  1.10000
        0.0   0.0000  1.10000
      180.0   0.0000  1.10000

reynolds 30000
# alpha_deg      cl       cd
     -180.0   0.0000  1.20000
        0.0   0.0000  1.20000
      180.0   0.0000  1.20000

reynolds 100000
# alpha_deg      cl       cd
     -180.0   0.0000  1.20000
        0.0   0.0000  1.20000
      180.0   0.0000  1.20000

reynolds 200000
# alpha_deg      cl       cd
     -180.0   0.0000  1.15000
        0.0   0.0000  1.15000
      180.0   0.0000  1.15000

reynolds 400000
# alpha_deg      cl       cd
     -180.0   0.0000  0.30000
        0.0   0.0000  0.30000
      180.0   0.0000  0.30000

reynolds 1000000
# alpha_deg      cl       cd
     -180.0   0.0000  0.35000
        0.0   0.0000  0.35000
      180.0   0.0000  0.35000

reynolds 3500000
# alpha_deg      cl       cd
     -180.0   0.0000  0.70000
        0.0   0.0000  0.70000
      180.0   0.0000  0.70000
