import "../hair/hair";
