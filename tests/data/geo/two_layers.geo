// Two layers and a hole.
DefineConstant[ h = 0.5, with_hole = 1 ];
c = h * (1 + 1);
Point(1) = {0, 0, 0, c}; Point(2) = {4, 0, 0, c}; Point(3) = {4, 1, 0}; Point(4) = {4, 2, 0, c/2};
Point(5) = {0, 2, 0, c}; Point(6) = {0, 1, 0, c}; Point(7) = {2, 1.2, 0, c};
Point(11) = {1, 0.25, 0}; Point(12) = {1.5, 0.25, 0}; Point(13) = {1, 0.5, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Line(7) = {6, 7}; Line(8) = {3, 7};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 11};
Physical Curve("Bottom", 20) = {1};
Curve Loop(1) = {1, 2, 8, -7, 6};
Curve Loop(2) = {7, -8, 3, 4, 5};
Curve Loop(3) = {11, 12, 13};
Plane Surface(1) = {1, 3};
Plane Surface(2) = {2};
/* names */
Physical Surface("sand", 1) = {1};
If ( with_hole > 0 )
  Physical Surface("shale", 2) = {2};
EndIf
