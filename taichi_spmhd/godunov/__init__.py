"""What Godunov's scheme does between a pair of particles: limited states, a Riemann problem, characteristics.

The pair's axis is e, from j to i: i is the right side of the problem, j the left one. Nothing here knows of particles;
numbers may be lanes (lanes.py). The terms GodunovHydro and GodunovMHD put these together (lecture pp. 22-23; Inutsuka
2002; Iwasaki & Inutsuka 2011).
"""
