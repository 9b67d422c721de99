polar 1
name no friction
reynolds 1e6
-180 0 0
0 0 0
180 0 0
