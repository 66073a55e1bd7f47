import sys
from osgeo import gdal
import numpy as np
a=gdal.Open(sys.argv[1]).ReadAsArray(); b=gdal.Open(sys.argv[2]).ReadAsArray()
if sys.argv[3]=='c': # a certified, b visible
    w=((a==2)&(b!=1))|((a==1)&(b!=0))|((a==255)!=(b==255))
else: w=a!=b
ys,xs=np.nonzero(w); print(w.sum(), [(int(x),int(y),int(a[y,x]),int(b[y,x])) for x,y in list(zip(xs,ys))[:12]])
